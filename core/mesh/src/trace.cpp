#include "qmcf/mesh/trace.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace qmcf {
namespace {

constexpr std::size_t kMostFailed = 64;  // 32 pairs.

}  // namespace

std::string_view traceKindName(TraceKind kind) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"start",      "star",     "seed",     "quad",   "collision",    "closure",  "seam",
       "transition", "leftover", "paired",   "strip",  "triangulated", "cleanup",  "smooth",
       "doublet",    "pair",     "collapse", "refill", "cavity",       "untangle", "subdivision"});
  return kNames[static_cast<std::size_t>(kind)];
}

bool operator==(const FaceTrace& a, const FaceTrace& b) {
  const auto same = [](const TraceStep& s, const TraceStep& t) {
    return s.kind == t.kind && s.isReset == t.isReset && s.base == t.base && s.pass == t.pass && s.undone == t.undone &&
           s.failed == t.failed && s.boundary == t.boundary && s.vertices == t.vertices && s.elements == t.elements &&
           s.removed == t.removed && s.states == t.states;
  };
  return std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(), same);
}

void TraceRecorder::begin(TraceKind kind, EditMesh& mesh) {
  pending_ = {};
  pending_.kind = kind;
  pending_.isReset = true;
  vertexCount_ = elementCount_ = 0;
  vertexNumber_.clear();
  positions_.clear();
  shown_.clear();
  noteBoundary(mesh);
  for (std::size_t f = 0; f < mesh.faceCapacity(); ++f) noteFace(mesh, FaceId(f));
  trace_.steps.push_back(std::move(pending_));
  pending_ = {};
  mesh.watch(this);
}

void TraceRecorder::next(TraceKind kind, std::int32_t a, std::int32_t b, std::int32_t pass) {
  pending_.kind = kind;
  pending_.base = {a < 0 ? kNone : known(VertexId(a)), b < 0 ? kNone : known(VertexId(b))};
  pending_.pass = pass;
}

void TraceRecorder::failed(VertexId a, VertexId b) {
  if (pending_.failed.size() < kMostFailed) pending_.failed.insert(pending_.failed.end(), {known(a), known(b)});
}

void TraceRecorder::state(VertexId a, VertexId b, TraceState state) {
  trace_.steps.back().states.push_back({known(a), known(b), static_cast<std::int32_t>(state)});
}

std::int32_t TraceRecorder::known(VertexId v) const {
  return v.index() < vertexNumber_.size() ? vertexNumber_[v.index()] : kNone;
}

std::array<std::int32_t, 3> TraceRecorder::rounded(const Vec3& p) const {
  const auto whole = [this](double x) { return static_cast<std::int32_t>(std::floor(x / scale_.unit + 0.5)); };
  return {whole(p.x - scale_.origin.x), whole(p.y - scale_.origin.y), whole(p.z - scale_.origin.z)};
}

std::int32_t TraceRecorder::vertexNumber(const EditMesh& mesh, VertexId v) {
  if (v.index() >= vertexNumber_.size()) vertexNumber_.resize(mesh.vertexCapacity(), kNone);
  std::int32_t& number = vertexNumber_[v.index()];
  if (number == kNone) {
    number = vertexCount_++;
    positions_.push_back(rounded(mesh.position(v)));
    const auto& p = positions_.back();
    pending_.vertices.push_back({number, p[0], p[1], p[2]});
  }
  return number;
}

void TraceRecorder::noteVertex(const EditMesh& mesh, VertexId v) {
  const std::int32_t number = known(v);
  if (number == kNone || !mesh.alive(v)) return;
  const auto p = rounded(mesh.position(v));
  if (positions_[static_cast<std::size_t>(number)] == p) return;
  positions_[static_cast<std::size_t>(number)] = p;
  pending_.vertices.push_back({number, p[0], p[1], p[2]});
}

void TraceRecorder::noteFace(const EditMesh& mesh, FaceId f) {
  if (f.index() >= shown_.size()) shown_.resize(std::max(f.index() + 1, mesh.faceCapacity()));
  const bool isElement = mesh.kind(f) == FaceKind::element;
  std::array<std::int32_t, 4> corners{kNone, kNone, kNone, kNone};
  if (isElement) {
    const auto sides = mesh.sides(f);
    for (std::size_t i = 0; i < 4 && sides[i].valid(); ++i) corners[i] = vertexNumber(mesh, mesh.origin(sides[i]));
  }
  Shown& shown = shown_[f.index()];
  if (shown.isThere == isElement && (!isElement || shown.corners == corners)) return;
  if (isElement) {
    if (shown.number == kNone) shown.number = elementCount_++;
    pending_.elements.push_back({shown.number, corners[0], corners[1], corners[2], corners[3]});
  } else {
    pending_.removed.push_back(shown.number);
  }
  shown.isThere = isElement;
  shown.corners = corners;
}

void TraceRecorder::noteBoundary(const EditMesh& mesh) {
  std::vector<bool> isSeen(mesh.halfedgeCapacity(), false);
  for (std::size_t i = 0; i < mesh.halfedgeCapacity(); ++i) {
    HalfedgeId h(i);
    if (isSeen[i] || !mesh.alive(h) || mesh.twin(h).valid()) continue;
    std::vector<std::int32_t>& loop = pending_.boundary.emplace_back();
    do {
      isSeen[h.index()] = true;
      loop.push_back(vertexNumber(mesh, mesh.origin(h)));
      h = mesh.next(h);
      while (mesh.twin(h).valid()) h = mesh.next(mesh.twin(h));
    } while (!isSeen[h.index()]);
  }
}

/// Sweeps of smoothing that follow each other are one step. Returns whether this one was joined to the last.
bool TraceRecorder::joinSmoothing() {
  TraceStep& last = trace_.steps.back();
  if (pending_.kind != TraceKind::smooth || last.kind != TraceKind::smooth) return false;
  last.vertices.insert(last.vertices.end(), pending_.vertices.begin(), pending_.vertices.end());
  const auto byNumber = [](const auto& a, const auto& b) { return a[0] < b[0]; };
  std::stable_sort(last.vertices.begin(), last.vertices.end(), byNumber);
  // Of a vertex that moved several times the last place counts.
  std::vector<std::array<std::int32_t, 4>> kept;
  for (const auto& vertex : last.vertices) {
    if (!kept.empty() && kept.back()[0] == vertex[0]) kept.pop_back();
    kept.push_back(vertex);
  }
  last.vertices = std::move(kept);
  return true;
}

void TraceRecorder::onCommit(const EditMesh& mesh) {
  const EditMesh::Changes changes = mesh.changes();
  for (const FaceId f : changes.faces) noteFace(mesh, f);
  for (const VertexId v : changes.vertices) noteVertex(mesh, v);
  const TraceKind kind = pending_.kind;
  if (pending_.vertices.empty() && pending_.elements.empty() && pending_.removed.empty()) return;
  if (!joinSmoothing()) trace_.steps.push_back(std::move(pending_));
  pending_ = {};
  pending_.kind = kind;
}

}  // namespace qmcf
