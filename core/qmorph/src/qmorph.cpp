// The original Q-Morph: section 4.1 of the paper (Owen, Staten, Canann, Saigal 1999; C of docs/algorithm.md).
#include "qmcf/qmorph/qmorph.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "morph_mesh.hpp"
#include "qmcf/base/math.hpp"
#include "qmcf/front/extract.hpp"
#include "qmcf/front/leftover.hpp"
#include "qmcf/front/loops.hpp"
#include "qmcf/front/quad_formation.hpp"
#include "qmcf/front/recovery.hpp"
#include "qmcf/front/seam.hpp"
#include "qmcf/mesh/element_shape.hpp"
#include "side_choice.hpp"
#include "smoothing.hpp"
#include "state_queue.hpp"
#include "transition.hpp"

namespace qmcf {
namespace {

/// A node whose front angle is smaller needs no side edge of its own: the front edge beyond is it.
constexpr double kSideThere = 0.75 * math::kPi;
/// Least shape of a new quad, by how desperate the front is.
constexpr std::array<double, 3> kLeastMorph{0.2, 0.08, 0.02};
constexpr int kMorphPasses = static_cast<int>(kLeastMorph.size());
/// Number of ways of getting a side edge that are tried, likewise.
constexpr std::array<std::size_t, 3> kSideTries{1, 3, 5};
constexpr int kManyQuads = 5;
/// Loops of up to so many edges that got stuck are filled at once.
constexpr int kLargestFilled = 10;

/// State of a front edge: which of its nodes have their side edge already.
struct FrontState {
  bool left = false;
  bool right = false;
  [[nodiscard]] std::int32_t rank() const { return 2 - (left ? 1 : 0) - (right ? 1 : 0); }
};

/// One way of making a quad on a base edge.
struct QuadPlan {
  std::size_t left = 0;  ///< Which of the side choices.
  std::size_t right = 0;
  bool halveLeft = false;  ///< Use the midpoint of the side edge, because its end would leave odd loops.
  bool halveRight = false;
};

class Morph {
 public:
  Morph(const Patch& patch, const TriangleBvh& face, const MorphOptions& options, TraceRecorder* trace)
      : morph_(patch, face), options_(options), trace_(trace) {}

  Result<MorphResult> run(Progress& progress);

 private:
  enum class Outcome : std::uint8_t { done, failed, odd };

  EditMesh& mesh() { return morph_.mesh(); }
  FrontMesh& front() { return morph_.front(); }
  [[nodiscard]] FrontState stateOf(HalfedgeId h) const;
  [[nodiscard]] bool wantsSeam(HalfedgeId h) const;
  /// What the next commit will be, for the trace.
  void note(TraceKind kind, HalfedgeId base, int pass);
  void enqueue(HalfedgeId h);
  void enqueueAround(const std::vector<VertexId>& vertices);
  void placeSeed();
  bool advanceFrom(HalfedgeId h, int pass);
  bool closeSmallLoop(HalfedgeId h, int pass);
  bool closeBadLoop(HalfedgeId h, const std::vector<VertexId>& corners, double least);
  bool closeWedge(HalfedgeId apex, int pass);
  bool makeTransition(HalfedgeId h, int pass);
  bool makeQuad(HalfedgeId base, int pass);
  Outcome tryQuad(HalfedgeId base, const FrontState& state, const QuadPlan& plan, int pass);
  VertexId makeSide(HalfedgeId sector, VertexId other, std::size_t choice, bool halve);
  void finish(const std::vector<VertexId>& corners, std::int32_t newLevel);
  std::int32_t& level(HalfedgeId h) {
    if (h.index() >= levels_.size()) levels_.resize(std::max(h.index() + 1, 2 * levels_.size()), kNoLevel);
    return levels_[h.index()];
  }

  static constexpr std::int32_t kNoLevel = -1;

  MorphMesh morph_;
  MorphOptions options_;
  MorphStatistics statistics_;
  StateQueue queue_;
  std::vector<std::int32_t> levels_;  ///< Per half-edge: rows of quads from where the front began.
  TraceRecorder* trace_;              ///< nullptr: nobody wants the history.
};

void Morph::note(TraceKind kind, HalfedgeId base, int pass) {
  if (trace_ != nullptr) trace_->next(kind, mesh().origin(base).value, mesh().target(base).value, pass);
}

FrontState Morph::stateOf(HalfedgeId h) const {
  return {morph_.front().sectorAngle(h) < kSideThere,
          morph_.front().sectorAngle(morph_.front().nextFront(h)) < kSideThere};
}

bool Morph::wantsSeam(HalfedgeId h) const {
  const VertexId v = morph_.mesh().origin(h);
  const bool busy = morph_.front().surroundings(v).elements >= kManyQuads;
  return morph_.front().sectorAngle(h) < (busy ? options_.busySeam : options_.seam);
}

void Morph::enqueue(HalfedgeId h) {
  if (level(h) == kNoLevel) level(h) = 0;
  const bool seam = wantsSeam(h) || wantsSeam(front().nextFront(h));
  const std::int32_t rank = stateOf(h).rank();
  queue_.push(h, seam ? -1 : rank, level(h), morph_.length(h));
  if (trace_ != nullptr)
    trace_->state(mesh().origin(h), mesh().target(h), seam ? TraceState::seam : static_cast<TraceState>(rank));
}

void Morph::enqueueAround(const std::vector<VertexId>& vertices) {
  std::vector<HalfedgeId> edges;
  for (const VertexId v : vertices) {
    if (!mesh().alive(v)) continue;
    const auto at = frontEdgesAt(front(), v);
    edges.insert(edges.end(), at.begin(), at.end());
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const HalfedgeId h : edges) enqueue(h);
}

/// Smooths around a change and brings the front edges' levels and states up to date.
void Morph::finish(const std::vector<VertexId>& corners, std::int32_t newLevel) {
  for (const VertexId v : corners) {
    for (const HalfedgeId h : frontEdgesAt(front(), v)) {
      if (level(h) == kNoLevel) level(h) = newLevel;
    }
  }
  const auto touched = smoothAround(morph_, corners);
  mesh().commit();
  enqueueAround(touched);
}

/// A loop of front edges in which no good quads fit: by moving its nodes, or, if it has four, by merging two of them.
bool Morph::closeBadLoop(HalfedgeId h, const std::vector<VertexId>& corners, double least) {
  constexpr double kAnyShape = -10.0;
  const std::size_t mark = mesh().mark();
  const bool filled = !closeLoop(front(), h, static_cast<int>(corners.size()), kAnyShape).empty();
  if (filled && untangle(morph_, corners, least)) {
    finish(corners, 0);
    return true;
  }
  mesh().rollback(mark);
  if (corners.size() != 4) return false;
  const VertexId kept = closeDiamond(front(), corners, least);
  if (kept.valid()) finish({kept}, 0);
  return kept.valid();
}

/// What is left of the front when it closes: a triangle, a quad or, where it got stuck, a few quads at once.
bool Morph::closeSmallLoop(HalfedgeId h, int pass) {
  const auto length = front().loopLength(h, pass == 0 ? 4 : kLargestFilled);
  if (!length || !front().turnsInward(h)) return false;
  note(TraceKind::closure, h, pass);
  std::vector<VertexId> corners;
  HalfedgeId e = h;
  for (int i = 0; i < *length; ++i, e = front().nextFront(e)) corners.push_back(mesh().origin(e));
  const double least = kLeastMorph[static_cast<std::size_t>(pass)];
  const bool closed = *length == 3   ? formElement(front(), corners, 0.0).has_value()
                      : *length == 4 ? formElement(front(), corners, least).has_value()
                                     : !closeLoop(front(), h, *length, least).empty();
  if (closed) finish(corners, 0);
  return closed || (pass > 0 && *length > 3 && closeBadLoop(h, corners, least));
}

bool Morph::closeWedge(HalfedgeId apex, int pass) {
  if (!wantsSeam(apex)) return false;
  const double least = 0.5 * kLeastMorph[static_cast<std::size_t>(pass)];
  note(TraceKind::seam, apex, pass);
  if (morph_.lengthRatio(apex) > options_.largestRatio) {
    note(TraceKind::transition, apex, pass);
    const auto corners = transitionSeam(morph_, apex, least);
    if (corners.empty()) return false;
    ++statistics_.transitions;
    finish(corners, level(apex));
    return true;
  }
  const std::int32_t newLevel = level(apex);
  const VertexId kept = closeSeam(front(), apex, least);
  if (!kept.valid()) return false;
  ++statistics_.seams;
  finish({kept}, newLevel);
  return true;
}

bool Morph::makeTransition(HalfedgeId h, int pass) {
  if (morph_.lengthRatio(h) <= options_.largestRatio || front().sectorAngle(h) >= math::kPi) return false;
  const std::int32_t newLevel = level(h);
  note(TraceKind::transition, h, pass);
  const HalfedgeId created = transitionSplit(morph_, h, kLeastMorph[static_cast<std::size_t>(pass)]);
  if (!created.valid()) return false;
  ++statistics_.transitions;
  for (const HalfedgeId e : {created, front().nextFront(created), front().previousFront(created)}) level(e) = newLevel;
  // Both side edges of the new front edge are there now, whatever its angles.
  if (tryQuad(created, {true, true}, {}, kMorphPasses - 1) == Outcome::done) return true;
  finish({mesh().origin(created), mesh().target(created)}, newLevel);
  return true;
}

VertexId Morph::makeSide(HalfedgeId sector, VertexId other, std::size_t choice, bool halve) {
  const auto choices = sideChoices(morph_, sector, other, options_);
  if (choice >= choices.size()) return {};
  const SideChoice& chosen = choices[choice];
  const VertexId end = realize(morph_, chosen);
  if (!halve) {
    ++(chosen.kind == SideChoice::Kind::existing ? statistics_.existing
       : chosen.kind == SideChoice::Kind::swap   ? statistics_.swaps
                                                 : statistics_.splits);
    return end;
  }
  const VertexId from = mesh().origin(sector);
  const HalfedgeId side = mesh().find(from, end);
  if (!side.valid() || front().isFree(end)) return {};
  return mesh().splitEdge(side,
                          morph_.place(mesh().vertex(from), (mesh().position(from) + mesh().position(end)) * 0.5));
}

Morph::Outcome Morph::tryQuad(HalfedgeId base, const FrontState& state, const QuadPlan& plan, int pass) {
  EditMesh& m = mesh();
  const HalfedgeId following = front().nextFront(base);
  const HalfedgeId previous = front().previousFront(base);
  const VertexId a = m.origin(base);
  const VertexId b = m.target(base);
  const std::int32_t newLevel = level(base) + 1;
  const std::size_t mark = m.mark();
  const auto undo = [&](Outcome outcome) {
    m.rollback(mark);
    ++statistics_.rollbacks;
    if (trace_ != nullptr) trace_->undone();
    return outcome;
  };
  note(TraceKind::quad, base, pass);

  VertexId c = state.right ? m.target(following) : VertexId();
  const VertexId d = state.left ? m.origin(previous) : makeSide(base, c, plan.left, plan.halveLeft);
  if (!d.valid()) return undo(Outcome::failed);
  if (!state.right) c = makeSide(following, d, plan.right, plan.halveRight);
  if (!c.valid() || c == d || c == a || d == b) return undo(Outcome::failed);
  const HalfedgeId downwards = m.find(d, a);
  if (!downwards.valid() || !m.isOpen(downwards)) return undo(Outcome::failed);
  const HalfedgeId top = m.find(c, d);
  if (!(top.valid() && m.isOpen(top)) && !recoverEdge(front(), downwards, c).valid()) return undo(Outcome::failed);

  std::vector<HalfedgeId> before;
  const bool joins =
      (!state.left && !front().isFree(d)) || (!state.right && !front().isFree(c)) || (state.left && state.right);
  const std::vector<VertexId> corners{a, b, c, d};
  const auto frontEdges = [&] {
    std::vector<HalfedgeId> edges;
    for (const VertexId v : corners) {
      const auto at = frontEdgesAt(front(), v);
      edges.insert(edges.end(), at.begin(), at.end());
    }
    return edges;
  };
  const int oddBefore = joins ? oddLoops(front(), frontEdges()) : 0;
  if (!formElement(front(), corners, kLeastMorph[static_cast<std::size_t>(pass)])) return undo(Outcome::failed);
  if (joins && pass + 1 < kMorphPasses && oddLoops(front(), frontEdges()) > oddBefore) return undo(Outcome::odd);
  if (joins) {
    ++statistics_.collisions;
    note(TraceKind::collision, base, pass);
  }
  finish(corners, newLevel);
  return Outcome::done;
}

bool Morph::makeQuad(HalfedgeId base, int pass) {
  const FrontState state = stateOf(base);
  const std::size_t tries = kSideTries[static_cast<std::size_t>(pass)];
  const std::size_t lefts = state.left ? 1 : tries;
  const std::size_t rights = state.right ? 1 : tries;
  for (std::size_t sum = 0; sum + 1 < lefts + rights; ++sum) {
    for (std::size_t left = 0; left <= std::min(sum, lefts - 1); ++left) {
      const std::size_t right = sum - left;
      if (right >= rights) continue;
      const Outcome outcome = tryQuad(base, state, {left, right, false, false}, pass);
      if (outcome == Outcome::done) return true;
      if (outcome == Outcome::failed) continue;
      for (const auto& [halveLeft, halveRight] : {std::pair{true, false}, {false, true}, {true, true}}) {
        if ((halveLeft && state.left) || (halveRight && state.right)) continue;
        if (tryQuad(base, state, {left, right, halveLeft, halveRight}, pass) == Outcome::done) return true;
      }
    }
  }
  return false;
}

bool Morph::advanceFrom(HalfedgeId h, int pass) {
  if (closeSmallLoop(h, pass)) return true;
  const HalfedgeId following = front().nextFront(h);
  if (closeWedge(h, pass) || closeWedge(following, pass)) return true;
  const FrontState state = stateOf(h);
  if (state.rank() != 0) {
    if (makeTransition(h, pass) || makeTransition(following, pass)) return true;
    // A much shorter neighbour goes first.
    for (const HalfedgeId neighbour : {front().previousFront(h), following}) {
      if (morph_.length(h) <= options_.largestRatio * morph_.length(neighbour)) continue;
      if (makeQuad(neighbour, pass)) {
        if (front().isFront(h)) enqueue(h);
        return true;
      }
    }
  }
  return makeQuad(h, pass);
}

/// On a closed surface, the best pair of triangles is the quad that the front starts from.
void Morph::placeSeed() {
  for (std::size_t i = 0; i < mesh().halfedgeCapacity(); ++i) {
    if (front().isFront(HalfedgeId(i))) return;
  }
  HalfedgeId best;
  double bestShape = 0.0;
  for (std::size_t i = 0; i < mesh().halfedgeCapacity(); ++i) {
    const HalfedgeId h(i);
    const HalfedgeId t = mesh().twin(h);
    if (t < h) continue;
    const double shape = quadShape(
        mesh(), {mesh().origin(h), mesh().origin(mesh().prev(t)), mesh().origin(t), mesh().origin(mesh().prev(h))});
    if (shape > bestShape) {
      best = h;
      bestShape = shape;
    }
  }
  if (!best.valid()) return;
  const HalfedgeId t = mesh().twin(best);
  if (trace_ != nullptr) trace_->next(TraceKind::seed);
  mesh().fill({mesh().next(best), mesh().prev(best), mesh().next(t), mesh().prev(t)},
              {mesh().face(best), mesh().face(t)}, FaceKind::element);
  mesh().commit();
}

Result<MorphResult> Morph::run(Progress& progress) {
  if (trace_ != nullptr) trace_->begin(TraceKind::start, mesh());
  placeSeed();
  for (std::size_t i = 0; i < mesh().halfedgeCapacity(); ++i) {
    if (front().isFront(HalfedgeId(i))) enqueue(HalfedgeId(i));
  }
  const std::size_t triangles = front().patch().surface.triangleCount();
  // Every success consumes open area and every failure waits for one; the bound is far above what that takes.
  const std::size_t maxSteps = 2000 + 60 * triangles;
  std::vector<HalfedgeId> failed;
  int pass = 0;
  bool advanced = false;
  std::size_t formed = 0;
  for (std::size_t step = 0; step < maxSteps; ++step) {
    if (step % 64 == 0) {
      const double done = 2.0 * static_cast<double>(formed) / static_cast<double>(triangles);
      if (!progress.report(Stage::front, std::min(1.0, done))) return cancelledError();
    }
    const HalfedgeId h = queue_.pop();
    if (h.valid()) {
      if (!front().isFront(h)) continue;
      if (!advanceFrom(h, pass)) {
        failed.push_back(h);
        if (trace_ != nullptr) trace_->failed(mesh().origin(h), mesh().target(h));
        continue;
      }
      ++formed;
      advanced = true;
      if (pass == 0) continue;
    } else if (failed.empty() || (!advanced && ++pass == kMorphPasses)) {
      break;
    }
    // After any success on a desperate pass, or when nothing is left to try, the others get another chance.
    if (advanced) pass = 0;
    advanced = false;
    for (const HalfedgeId e : failed) {
      if (front().isFront(e)) enqueue(e);
    }
    failed.clear();
  }
  if (trace_ != nullptr) trace_->next(TraceKind::leftover);
  removeFreeVertices(front());
  statistics_.recombined = pairTriangles(front());
  mesh().commit();
  MorphResult result{extract(front()), statistics_};
  for (const Element& element : result.mesh.elements) {
    ++(cornerCount(element) == 4 ? result.statistics.quads : result.statistics.triangles);
  }
  return result;
}

}  // namespace

Result<MorphResult> advanceMorph(const Patch& patch, const TriangleBvh& face, const MorphOptions& options,
                                 Progress& progress, TraceRecorder* trace) {
  return Morph(patch, face, options, trace).run(progress);
}

}  // namespace qmcf
