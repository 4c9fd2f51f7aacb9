// The advancing front of QMCF: section 4 of the paper (Owen et al. 1999 with side edges from cross field and size
// field).
#include "qmcf/front/advancing_front.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "failed_attempts.hpp"
#include "front_queue.hpp"
#include "qmcf/front/extract.hpp"
#include "qmcf/front/front_mesh.hpp"
#include "qmcf/front/leftover.hpp"
#include "qmcf/front/loops.hpp"
#include "qmcf/front/quad_formation.hpp"
#include "qmcf/front/recovery.hpp"
#include "qmcf/front/seam.hpp"
#include "side_edge.hpp"
#include "star.hpp"

namespace qmcf {
namespace {

/// Least quality of a new quad and of the triangles beside it, by how desperate the front is.
constexpr std::array<double, 3> kLeastQuad{0.3, 0.12, 0.03};
/// Shortest and longest side of a new quad in element sizes, likewise.
constexpr std::array<double, 3> kShortest{0.4, 0.25, 0.0};
constexpr std::array<double, 3> kLongest{1.9, 2.8, 6.0};
constexpr int kPasses = static_cast<int>(kLeastQuad.size());
static_assert(kLeastQuad.size() == FailedAttempts::kPasses);
constexpr std::size_t kMaxAttempts = 6;
/// After so many successes per failure the failures are tried again: often enough to catch what became possible, seldom
/// enough for a front with thousands of them.
constexpr std::size_t kRetryShare = 16;

class Advance {
 public:
  Advance(const Patch& patch, const CrossField& field, const FrontOptions& options, TraceRecorder* trace)
      : front_(patch, field), options_(options), trace_(trace) {}

  Result<FrontResult> run(Progress& progress);

 private:
  EditMesh& mesh() { return front_.mesh(); }

  void startFronts();
  /// What the next commit will be, for the trace.
  void note(TraceKind kind, HalfedgeId base, int pass);
  /// wantedLeft, wantedRight: the quads wanted at both ends of the edge.
  void enqueue(HalfedgeId h, int wantedLeft, int wantedRight);
  void enqueue(HalfedgeId h) { enqueue(h, front_.wantedQuads(h), front_.wantedQuads(front_.nextFront(h))); }
  void enqueueAround(const std::vector<VertexId>& vertices);
  void commit();
  bool advanceFrom(HalfedgeId h, int pass);
  std::vector<SideProposal> sides(HalfedgeId sector, int wanted, bool left, const std::optional<Vec3>& closure,
                                  int pass) const;
  FaceId form(HalfedgeId base, const SideProposal& left, const SideProposal& right, int pass);
  std::vector<VertexId> cornersOf(FaceId f) const;
  std::vector<HalfedgeId> edgesAt(const std::vector<VertexId>& vertices) const;
  bool tryQuad(HalfedgeId base, const SideProposal& left, const SideProposal& right, int pass);
  VertexId realize(HalfedgeId sector, const SideProposal& side);
  bool fitsSize(VertexId a, VertexId b, int pass) const;
  void finishQuad(FaceId f, int level);
  void relaxAround(const std::vector<VertexId>& vertices);
  std::int32_t& level(HalfedgeId h) {
    if (h.index() >= levels_.size()) levels_.resize(std::max(h.index() + 1, 2 * levels_.size()), 0);
    return levels_[h.index()];
  }

  FrontMesh front_;
  FrontOptions options_;
  FrontStatistics statistics_;
  FrontQueue queue_;
  std::vector<std::int32_t> levels_;
  FailedAttempts attempts_;
  bool wasOdd_ = false;   ///< The last attempt failed because of loops, which reach far.
  TraceRecorder* trace_;  ///< nullptr: nobody wants the history.
};

void Advance::note(TraceKind kind, HalfedgeId base, int pass) {
  if (trace_ != nullptr) trace_->next(kind, mesh().origin(base).value, mesh().target(base).value, pass);
}

void Advance::enqueue(HalfedgeId h, int wantedLeft, int wantedRight) {
  const bool seam = wantedLeft == 0 || wantedRight == 0;
  const int open = (wantedLeft > 1 ? 1 : 0) + (wantedRight > 1 ? 1 : 0);
  queue_.push(h, seam ? -1 : level(h), open);
  if (trace_ != nullptr)
    trace_->state(mesh().origin(h), mesh().target(h), seam ? TraceState::seam : static_cast<TraceState>(open));
}

void Advance::enqueueAround(const std::vector<VertexId>& vertices) {
  std::vector<HalfedgeId> edges = edgesAt(vertices);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  // Most of them follow each other, so that each number is asked for by two.
  constexpr int kUnknown = -1;
  std::vector<int> wanted(edges.size(), kUnknown);
  const auto wantedAt = [&](HalfedgeId h) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), h);
    if (at == edges.end() || *at != h) return front_.wantedQuads(h);
    int& known = wanted[static_cast<std::size_t>(at - edges.begin())];
    if (known == kUnknown) known = front_.wantedQuads(h);
    return known;
  };
  for (const HalfedgeId h : edges) enqueue(h, wantedAt(h), wantedAt(front_.nextFront(h)));
}

void Advance::commit() {
  attempts_.noteChange(mesh());
  mesh().commit();
}

VertexId Advance::realize(HalfedgeId sector, const SideProposal& side) {
  if (side.existing.valid()) return side.existing;
  constexpr double kReuse = 0.4;
  return insertVertex(front_, sector, side.vertex, kReuse * front_.sizeAt(side.vertex.location));
}

bool Advance::fitsSize(VertexId a, VertexId b, int pass) const {
  const EditMesh& view = front_.mesh();
  const double size = 0.5 * (front_.sizeAt(view.vertex(a).location) + front_.sizeAt(view.vertex(b).location));
  const double length = distance(view.position(a), view.position(b)) / size;
  return length >= kShortest[static_cast<std::size_t>(pass)] && length <= kLongest[static_cast<std::size_t>(pass)];
}

std::vector<SideProposal> Advance::sides(HalfedgeId sector, int wanted, bool left, const std::optional<Vec3>& closure,
                                         int pass) const {
  const EditMesh& view = front_.mesh();
  if (wanted > 1) return proposeSide(front_, {sector, wanted, left, closure, pass + 1 == kPasses}, options_);
  SideProposal there;
  there.existing = left ? view.origin(front_.previousFront(sector)) : view.target(sector);
  there.vertex = view.vertex(there.existing);
  return {there};
}

bool Advance::advanceFrom(HalfedgeId h, int pass) {
  EditMesh& m = mesh();
  const HalfedgeId following = front_.nextFront(h);
  const int length = front_.loopLength(h, 6).value_or(7);
  note(TraceKind::closure, h, pass);
  if (length <= 6 && front_.turnsInward(h)) {
    const auto faces = closeLoop(front_, h, length, kLeastQuad[static_cast<std::size_t>(pass)]);
    if (!faces.empty()) {
      statistics_.quads += static_cast<std::int64_t>(faces.size());
      commit();
      return true;
    }
    if (length == 4) return false;
  }
  int wantedLeft = front_.wantedQuads(h);
  int wantedRight = front_.wantedQuads(following);
  for (const HalfedgeId apex : {h, following}) {
    if ((apex == h ? wantedLeft : wantedRight) != 0) continue;
    note(TraceKind::seam, h, pass);
    const VertexId kept = closeSeam(front_, apex, 0.5 * kLeastQuad[static_cast<std::size_t>(pass)]);
    if (!kept.valid()) continue;
    ++statistics_.seams;
    makeDelaunay(front_, {kept});
    relaxAround({kept});
    commit();
    std::vector<VertexId> around{kept};
    for (const HalfedgeId e : frontEdgesAt(front_, kept)) {
      around.push_back(m.origin(e));
      around.push_back(m.target(e));
    }
    enqueueAround(around);
    return true;
  }
  wantedLeft = std::max(1, wantedLeft);
  wantedRight = std::max(1, wantedRight);

  // Where one side is there already, the other one may complete a parallelogram.
  const Vec3 a = m.position(m.origin(h));
  const Vec3 b = m.position(m.target(h));
  std::optional<Vec3> leftClosure;
  std::optional<Vec3> rightClosure;
  if (wantedLeft == 1 && wantedRight == 2) rightClosure = b + (m.position(m.origin(front_.previousFront(h))) - a);
  if (wantedRight == 1 && wantedLeft == 2) leftClosure = a + (m.position(m.target(following)) - b);
  const auto lefts = sides(h, wantedLeft, true, leftClosure, pass);
  const auto rights = sides(following, wantedRight, false, rightClosure, pass);
  std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> order;
  for (std::size_t i = 0; i < lefts.size(); ++i) {
    for (std::size_t j = 0; j < rights.size(); ++j) order.push_back({lefts[i].cost + rights[j].cost, {i, j}});
  }
  std::sort(order.begin(), order.end());
  if (order.size() > kMaxAttempts) order.resize(kMaxAttempts);
  for (const auto& [cost, choice] : order) {
    note(TraceKind::quad, h, pass);
    if (tryQuad(h, lefts[choice.first], rights[choice.second], pass)) return true;
    ++statistics_.rollbacks;
    if (trace_ != nullptr) trace_->undone();
  }
  return false;
}

std::vector<VertexId> Advance::cornersOf(FaceId f) const {
  std::vector<VertexId> corners;
  for (const HalfedgeId h : front_.mesh().sides(f)) {
    if (h.valid()) corners.push_back(front_.mesh().origin(h));
  }
  return corners;
}

/// The front edges at those of the vertices that there are.
std::vector<HalfedgeId> Advance::edgesAt(const std::vector<VertexId>& vertices) const {
  std::vector<HalfedgeId> edges;
  for (const VertexId v : vertices) {
    if (!v.valid() || !front_.mesh().alive(v)) continue;
    const auto at = frontEdgesAt(front_, v);
    edges.insert(edges.end(), at.begin(), at.end());
  }
  return edges;
}

/// Makes the quad on a front edge with the given sides; an invalid id, with the mesh changed, where that can't be.
FaceId Advance::form(HalfedgeId base, const SideProposal& left, const SideProposal& right, int pass) {
  EditMesh& m = mesh();
  const HalfedgeId following = front_.nextFront(base);
  const VertexId a = m.origin(base);
  const VertexId b = m.target(base);
  const bool leftThere = left.existing.valid() && left.existing == m.origin(front_.previousFront(base));
  const bool rightThere = right.existing.valid() && right.existing == m.target(following);
  const VertexId d = realize(base, left);
  if (!d.valid()) return {};
  if (!leftThere && !recoverEdge(front_, base, d).valid()) return {};
  const VertexId c = realize(following, right);
  if (!c.valid() || c == d) return {};
  if (!leftThere && !fitsSize(a, d, pass)) return {};
  if (!rightThere && !fitsSize(b, c, pass)) return {};
  if (!fitsSize(c, d, pass)) return {};
  if (!rightThere && !recoverEdge(front_, following, c).valid()) return {};
  const HalfedgeId downwards = m.find(d, a);
  if (!downwards.valid() || !m.isOpen(downwards)) return {};
  const HalfedgeId top = m.find(c, d);
  if (!(top.valid() && m.isOpen(top)) && !recoverEdge(front_, downwards, c).valid()) return {};
  return formElement(front_, {a, b, c, d}, kLeastQuad[static_cast<std::size_t>(pass)]).value_or(FaceId());
}

bool Advance::tryQuad(HalfedgeId base, const SideProposal& left, const SideProposal& right, int pass) {
  EditMesh& m = mesh();
  const bool leftThere = left.existing.valid() && left.existing == m.origin(front_.previousFront(base));
  const bool rightThere = right.existing.valid() && right.existing == m.target(front_.nextFront(base));
  const bool joins =
      (left.existing.valid() && !leftThere) || (right.existing.valid() && !rightThere) || (leftThere && rightThere);
  if (left.existing.valid() && left.existing == right.existing) return false;

  const std::size_t mark = m.mark();
  const std::int32_t baseLevel = level(base);
  FaceId formed = form(base, left, right, pass);
  if (formed.valid() && joins && pass + 1 < kPasses) {
    // Loops are long: those before are looked at only where some are odd now.
    const int oddAfter = oddLoops(front_, edgesAt(cornersOf(formed)));
    if (oddAfter > 0) {
      m.rollback(mark);
      std::vector<HalfedgeId> before = edgesAt({left.existing, right.existing});
      before.push_back(base);
      wasOdd_ = oddAfter > oddLoops(front_, before);
      formed = wasOdd_ ? FaceId() : form(base, left, right, pass);
    }
  }
  if (!formed.valid()) {
    m.rollback(mark);
    return false;
  }
  const std::vector<VertexId> corners = cornersOf(formed);
  if (joins) {
    ++statistics_.collisions;
    note(TraceKind::collision, base, pass);
  }
  makeDelaunay(front_, corners);
  if (joins) relaxAround(corners);
  commit();
  finishQuad(formed, baseLevel);
  return true;
}

void Advance::finishQuad(FaceId f, int baseLevel) {
  EditMesh& m = mesh();
  ++statistics_.quads;
  for (const HalfedgeId h : m.sides(f)) {
    if (h.valid() && m.twin(h).valid() && front_.isFront(m.twin(h))) level(m.twin(h)) = baseLevel + 1;
  }
  enqueueAround(cornersOf(f));
}

/// Moves the free-standing nodes around a collision towards parallelograms (section 4.2: "relaxation near front
/// collisions").
void Advance::relaxAround(const std::vector<VertexId>& vertices) {
  EditMesh& m = mesh();
  std::vector<VertexId> moving = vertices;
  for (const VertexId v : vertices) {
    m.forEachOutgoing(v, [&](HalfedgeId h) { moving.push_back(m.target(h)); });
  }
  std::sort(moving.begin(), moving.end());
  moving.erase(std::unique(moving.begin(), moving.end()), moving.end());
  constexpr int kSweeps = 2;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const VertexId v : moving) {
      if (front_.isFixed(v)) continue;
      Vec3 sum;
      int count = 0;
      m.forEachOutgoing(v, [&](HalfedgeId h) {
        const FaceId f = m.face(h);
        if (m.kind(f) != FaceKind::element || m.cornerCount(f) != 4) return;
        const HalfedgeId n = m.next(h);
        sum += m.position(m.origin(n)) + m.position(m.origin(m.prev(h))) - m.position(m.origin(m.next(n)));
        ++count;
      });
      if (count < 2) continue;
      const Vec3 aim = (m.position(v) + sum / count) * 0.5;
      constexpr double kLeast = 0.3;
      front_.tryMove(v, front_.vertexNear(m.vertex(v).location, aim), kLeast);
    }
  }
}

void Advance::startFronts() {
  if (options_.patterns) {
    if (trace_ != nullptr) trace_->next(TraceKind::star);
    for (const Singularity& singularity : front_.field().singularities) {
      if (!placeStar(front_, singularity)) continue;
      ++statistics_.stars;
      mesh().commit();
    }
  }
  bool any = false;
  for (std::size_t i = 0; i < mesh().halfedgeCapacity() && !any; ++i) any = front_.isFront(HalfedgeId(i));
  if (trace_ != nullptr) trace_->next(TraceKind::seed);
  if (!any) placeSeed(front_, options_.seedPlace);
  mesh().commit();
  for (std::size_t i = 0; i < mesh().halfedgeCapacity(); ++i) {
    if (front_.isFront(HalfedgeId(i))) enqueue(HalfedgeId(i));
  }
}

Result<FrontResult> Advance::run(Progress& progress) {
  if (trace_ != nullptr) trace_->begin(TraceKind::start, mesh());
  startFronts();
  const double expected = static_cast<double>(front_.patch().surface.triangleCount());
  std::vector<HalfedgeId> failed;
  int pass = 0;
  bool advanced = false;
  std::size_t sinceRetry = 0;
  // Every success consumes open area and every failure waits for one; the bound is far above what that takes.
  const std::size_t maxSteps = 2000 + 40 * front_.patch().surface.triangleCount();
  for (std::size_t step = 0; step < maxSteps; ++step) {
    if (step % 64 == 0 &&
        !progress.report(Stage::front, std::min(1.0, static_cast<double>(statistics_.quads) / expected))) {
      return cancelledError();
    }
    const HalfedgeId h = queue_.pop();
    if (h.valid()) {
      if (!front_.isFront(h)) continue;
      if (attempts_.isVain(front_, h, pass)) {
        --step;
        failed.push_back(h);
        continue;
      }
      wasOdd_ = false;
      if (advanceFrom(h, pass)) {
        advanced = true;
        ++sinceRetry;
        if ((pass > 0 && sinceRetry > failed.size() / kRetryShare) || queue_.size() == 0) {
          sinceRetry = 0;
          for (const HalfedgeId e : failed) {
            if (front_.isFront(e)) enqueue(e);
          }
          failed.clear();
          pass = 0;
        }
      } else {
        failed.push_back(h);
        if (!wasOdd_) attempts_.noteFailure(h, pass);
        if (trace_ != nullptr) trace_->failed(mesh().origin(h), mesh().target(h));
      }
      continue;
    }
    if (failed.empty()) break;
    if (!advanced && ++pass == kPasses) break;
    if (advanced) pass = 0;
    advanced = false;
    for (const HalfedgeId e : failed) {
      if (front_.isFront(e)) enqueue(e);
    }
    failed.clear();
  }
  if (trace_ != nullptr) trace_->next(TraceKind::leftover);
  removeFreeVertices(front_);
  statistics_.recombined = pairTriangles(front_);
  mesh().commit();
  FrontResult result{extract(front_), statistics_};
  result.statistics.quads = 0;
  for (const Element& element : result.mesh.elements) {
    ++(cornerCount(element) == 4 ? result.statistics.quads : result.statistics.triangles);
  }
  return result;
}

}  // namespace

Result<FrontResult> advanceFront(const Patch& patch, const CrossField& field, const FrontOptions& options,
                                 Progress& progress, TraceRecorder* trace) {
  return Advance(patch, field, options, trace).run(progress);
}

FrontResult recombinePatch(const Patch& patch) {
  const CrossField none;
  FrontMesh front(patch, none);
  FrontResult result;
  result.statistics.recombined = pairTriangles(front);
  result.mesh = extract(front);
  for (const Element& element : result.mesh.elements) {
    ++(cornerCount(element) == 4 ? result.statistics.quads : result.statistics.triangles);
  }
  return result;
}

}  // namespace qmcf
