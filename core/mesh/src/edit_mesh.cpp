#include "qmcf/mesh/edit_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace qmcf {

EditMesh::EditMesh(const Surface& surface, const IdMap<VertexId, Vec3>& normals) {
  const std::size_t halfedges = surface.halfedgeCount();
  for (const Array array : {kNext, kPrev, kTwin, kOrigin, kFace}) links_[array].resize(halfedges);
  for (const HalfedgeId h : surface.halfedges()) {
    links_[kNext][h.index()] = Surface::next(h).value;
    links_[kPrev][h.index()] = Surface::prev(h).value;
    links_[kTwin][h.index()] = surface.twin(h).value;
    links_[kOrigin][h.index()] = surface.origin(h).value;
    links_[kFace][h.index()] = Surface::triangle(h).value;
  }
  links_[kFaceKind].assign(surface.triangleCount(), static_cast<std::int32_t>(FaceKind::open));
  links_[kFaceHalfedge].resize(surface.triangleCount());
  links_[kOutgoing].resize(surface.vertexCount());
  vertices_.resize(surface.vertexCount());
  for (const TriangleId t : surface.triangles()) links_[kFaceHalfedge][t.index()] = Surface::halfedge(t).value;
  for (const VertexId v : surface.vertices()) {
    const HalfedgeId h = surface.outgoing(v);
    links_[kOutgoing][v.index()] = h.value;
    SurfacePoint location{Surface::triangle(h), {0.0, 0.0, 0.0}};
    location.barycentric[static_cast<std::size_t>(h.value % 3)] = 1.0;
    vertices_[v] = {surface.position(v), normals[v], location};
  }
}

EditMesh::EditMesh(const FaceMesh& mesh) {
  vertices_.resize(mesh.positions.size());
  links_[kOutgoing].assign(mesh.positions.size(), kNone);
  for (const VertexId v : IdRange<VertexId>(mesh.positions.size())) {
    vertices_[v] = {mesh.positions[v.index()], mesh.normals[v.index()], mesh.locations[v.index()]};
  }
  std::vector<std::int32_t> leaving(mesh.positions.size() + 1, 0);  // Of the half-edges by origin, the first of each.
  for (std::size_t f = 0; f < mesh.elements.size(); ++f) {
    const Element& element = mesh.elements[f];
    const auto first = static_cast<std::int32_t>(halfedgeCapacity());
    const auto count = static_cast<std::int32_t>(qmcf::cornerCount(element));
    for (std::int32_t c = 0; c < count; ++c) {
      const std::int32_t from = element[static_cast<std::size_t>(c)];
      ++leaving[static_cast<std::size_t>(from) + 1];
      links_[kNext].push_back(first + (c + 1) % count);
      links_[kPrev].push_back(first + (c + count - 1) % count);
      links_[kOrigin].push_back(from);
      links_[kFace].push_back(static_cast<std::int32_t>(f));
    }
    links_[kFaceHalfedge].push_back(first);
    links_[kFaceKind].push_back(static_cast<std::int32_t>(FaceKind::element));
  }
  links_[kTwin].assign(halfedgeCapacity(), kNone);
  std::partial_sum(leaving.begin(), leaving.end(), leaving.begin());
  std::vector<HalfedgeId> byOrigin(halfedgeCapacity());
  std::vector<std::int32_t> place(leaving.begin(), leaving.end() - 1);
  for (std::size_t i = 0; i < halfedgeCapacity(); ++i) {
    const HalfedgeId h(i);
    byOrigin[static_cast<std::size_t>(place[origin(h).index()]++)] = h;
  }
  for (const VertexId v : IdRange<VertexId>(mesh.positions.size())) {
    const auto first = static_cast<std::size_t>(leaving[v.index()]);
    const auto last = static_cast<std::size_t>(leaving[v.index() + 1]);
    // A boundary half-edge, or the one to the smallest vertex.
    HalfedgeId chosen;
    for (std::size_t i = first; i < last; ++i) {
      const HalfedgeId h = byOrigin[i];
      const std::size_t to = target(h).index();
      for (auto j = static_cast<std::size_t>(leaving[to]); j < static_cast<std::size_t>(leaving[to + 1]); ++j) {
        if (target(byOrigin[j]) != v) continue;
        links_[kTwin][h.index()] = byOrigin[j].value;
        break;
      }
      const bool isFirst = !chosen.valid() || (twin(chosen).valid() && target(h) < target(chosen));
      if (isFirst || !twin(h).valid()) chosen = h;
    }
    links_[kOutgoing][v.index()] = chosen.value;
  }
}

HalfedgeId EditMesh::find(VertexId a, VertexId b) const {
  const HalfedgeId first = outgoing(a);
  HalfedgeId h = first;
  do {
    if (target(h) == b) return h;
    h = nextAround(h);
  } while (h.valid() && h != first);
  return {};
}

void EditMesh::set(Array array, std::size_t index, std::int32_t value) {
  std::int32_t& word = links_[array][index];
  if (word == value) return;
  journal_.push_back({Edit::word, static_cast<std::uint8_t>(array), static_cast<std::int32_t>(index), word});
  word = value;
}

void EditMesh::link(HalfedgeId first, HalfedgeId second) {
  set(kNext, first.index(), second.value);
  set(kPrev, second.index(), first.value);
}

void EditMesh::glue(HalfedgeId a, HalfedgeId b) {
  if (a.valid()) set(kTwin, a.index(), b.value);
  if (b.valid()) set(kTwin, b.index(), a.value);
}

void EditMesh::makeTriangle(FaceId f, HalfedgeId a, HalfedgeId b, HalfedgeId c) {
  link(a, b);
  link(b, c);
  link(c, a);
  for (const HalfedgeId h : {a, b, c}) set(kFace, h.index(), f.value);
  set(kFaceHalfedge, f.index(), a.value);
}

VertexId EditMesh::addVertex(const Vertex& vertex) {
  journal_.push_back({Edit::newVertex, 0, 0, 0});
  vertices_.push_back(vertex);
  links_[kOutgoing].push_back(kNone);
  return VertexId(vertices_.size() - 1);
}

HalfedgeId EditMesh::addEdge(VertexId a, VertexId b) {
  journal_.push_back({Edit::newHalfedges, 0, 0, 0});
  const auto first = static_cast<std::int32_t>(halfedgeCapacity());
  for (const Array array : {kNext, kPrev, kFace}) links_[array].insert(links_[array].end(), {kNone, kNone});
  links_[kTwin].insert(links_[kTwin].end(), {first + 1, first});
  links_[kOrigin].insert(links_[kOrigin].end(), {a.value, b.value});
  return HalfedgeId(first);
}

FaceId EditMesh::addFace(FaceKind kind) {
  journal_.push_back({Edit::newFace, 0, 0, 0});
  links_[kFaceHalfedge].push_back(kNone);
  links_[kFaceKind].push_back(static_cast<std::int32_t>(kind));
  return FaceId(faceCapacity() - 1);
}

void EditMesh::removeHalfedge(HalfedgeId h) {
  set(kOrigin, h.index(), kNone);
  set(kFace, h.index(), kNone);
}

void EditMesh::setVertex(VertexId v, const Vertex& vertex) {
  journal_.push_back({Edit::vertex, 0, v.value, 0});
  savedVertices_.push_back(vertices_[v]);
  vertices_[v] = vertex;
}

void EditMesh::flip(HalfedgeId h) {
  // h runs a -> b in (a, b, c), t runs b -> a in (b, a, d). Afterwards h runs d -> c in (d, c, a), t c -> d in (c, d,
  // b).
  const HalfedgeId t = twin(h);
  assert(isOpen(h) && t.valid() && isOpen(t));
  const HalfedgeId bc = next(h);
  const HalfedgeId ca = prev(h);
  const HalfedgeId ad = next(t);
  const HalfedgeId db = prev(t);
  const VertexId a = origin(h);
  const VertexId b = origin(t);
  if (outgoing(a) == h) set(kOutgoing, a.index(), ad.value);
  if (outgoing(b) == t) set(kOutgoing, b.index(), bc.value);
  set(kOrigin, h.index(), origin(db).value);
  set(kOrigin, t.index(), origin(ca).value);
  makeTriangle(face(h), h, ca, ad);
  makeTriangle(face(t), t, db, bc);
}

VertexId EditMesh::splitTriangle(FaceId f, const Vertex& vertex) {
  const HalfedgeId ab = halfedge(f);
  const HalfedgeId bc = next(ab);
  const HalfedgeId ca = next(bc);
  const VertexId v = addVertex(vertex);
  const HalfedgeId va = addEdge(v, origin(ab));
  const HalfedgeId vb = addEdge(v, origin(bc));
  const HalfedgeId vc = addEdge(v, origin(ca));
  set(kOutgoing, v.index(), va.value);
  makeTriangle(f, ab, twin(vb), va);
  makeTriangle(addFace(FaceKind::open), bc, twin(vc), vb);
  makeTriangle(addFace(FaceKind::open), ca, twin(va), vc);
  return v;
}

VertexId EditMesh::splitEdge(HalfedgeId h, const Vertex& vertex) {
  // h runs a -> b in (a, b, c); its twin t, if any, b -> a in (b, a, d).
  const HalfedgeId t = twin(h);
  const HalfedgeId bc = next(h);
  const HalfedgeId ca = prev(h);
  const VertexId a = origin(h);
  const VertexId b = origin(bc);
  const VertexId v = addVertex(vertex);
  const HalfedgeId vb = addEdge(v, b);
  const HalfedgeId vc = addEdge(v, origin(ca));
  set(kOutgoing, v.index(), vb.value);
  makeTriangle(face(h), h, vc, ca);
  makeTriangle(addFace(FaceKind::open), vb, bc, twin(vc));
  const HalfedgeId bv = twin(vb);
  if (!t.valid()) {
    removeHalfedge(bv);
    set(kTwin, vb.index(), kNone);
    return v;
  }
  // t keeps its origin b and becomes b -> v; the new half-edge bv becomes v -> a.
  const HalfedgeId ad = next(t);
  const HalfedgeId db = prev(t);
  const HalfedgeId va = bv;
  set(kOrigin, va.index(), v.value);
  const HalfedgeId vd = addEdge(v, origin(db));
  glue(h, va);
  glue(vb, t);
  makeTriangle(face(t), t, vd, db);
  makeTriangle(addFace(FaceKind::open), va, ad, twin(vd));
  assert(target(va) == a);
  static_cast<void>(a);
  return v;
}

void EditMesh::clear(const std::vector<HalfedgeId>& boundary, const std::vector<FaceId>& region) {
  for (const HalfedgeId h : boundary) set(kFace, h.index(), kNone);
  for (const FaceId f : region) {
    for (const HalfedgeId h : sides(f)) {
      if (!h.valid() || !face(h).valid()) continue;
      const VertexId v = origin(h);
      if (outgoing(v) == h) set(kOutgoing, v.index(), kNone);
      removeHalfedge(h);
    }
    setKind(f, FaceKind::removed);
  }
  for (const HalfedgeId h : boundary) {
    const VertexId v = origin(h);
    if (!outgoing(v).valid()) set(kOutgoing, v.index(), h.value);
  }
}

FaceId EditMesh::fill(const std::vector<HalfedgeId>& boundary, const std::vector<FaceId>& region, FaceKind kind) {
  clear(boundary, region);
  const FaceId f = addFace(kind);
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    link(boundary[i], boundary[(i + 1) % boundary.size()]);
    set(kFace, boundary[i].index(), f.value);
  }
  set(kFaceHalfedge, f.index(), boundary.front().value);
  return f;
}

std::vector<FaceId> EditMesh::fill(const std::vector<HalfedgeId>& boundary, const std::vector<FaceId>& region,
                                   const std::vector<std::array<int, 4>>& cells, const std::vector<Vertex>& inner) {
  std::vector<VertexId> vertices;
  for (const HalfedgeId h : boundary) vertices.push_back(origin(h));
  clear(boundary, region);
  for (const Vertex& vertex : inner) vertices.push_back(addVertex(vertex));
  std::vector<HalfedgeId> added;
  // Per vertex the last added half-edge that leaves it, and per added edge those of its ends before.
  std::vector<HalfedgeId> lastOut(vertices.size());
  std::vector<std::array<HalfedgeId, 2>> before;
  const auto firstAdded = static_cast<std::int32_t>(halfedgeCapacity());
  const auto halfedgeBetween = [&](int from, int to) {
    const auto count = static_cast<int>(boundary.size());
    if (from < count && to == (from + 1) % count) return boundary[static_cast<std::size_t>(from)];
    const auto i = static_cast<std::size_t>(from);
    const auto j = static_cast<std::size_t>(to);
    for (HalfedgeId h = lastOut[i]; h.valid();) {
      if (origin(twin(h)) == vertices[j]) return h;
      const std::int32_t place = h.value - firstAdded;
      h = before[static_cast<std::size_t>(place / 2)][static_cast<std::size_t>(place % 2)];
    }
    added.push_back(addEdge(vertices[i], vertices[j]));
    before.push_back({lastOut[i], lastOut[j]});
    lastOut[i] = added.back();
    lastOut[j] = twin(added.back());
    return added.back();
  };
  std::vector<FaceId> faces;
  for (const auto& cell : cells) {
    const FaceId f = addFace(FaceKind::element);
    std::array<HalfedgeId, 4> loop;
    for (std::size_t i = 0; i < 4; ++i) loop[i] = halfedgeBetween(cell[i], cell[(i + 1) % 4]);
    for (std::size_t i = 0; i < 4; ++i) {
      link(loop[i], loop[(i + 1) % 4]);
      set(kFace, loop[i].index(), f.value);
    }
    set(kFaceHalfedge, f.index(), loop[0].value);
    faces.push_back(f);
  }
  for (std::size_t i = added.size(); i-- > 0;) {
    for (const HalfedgeId out : {added[i], twin(added[i])}) {
      if (!outgoing(origin(out)).valid()) set(kOutgoing, origin(out).index(), out.value);
    }
  }
  return faces;
}

HalfedgeId EditMesh::cut(HalfedgeId from, HalfedgeId to) {
  const FaceId kept = face(from);
  const HalfedgeId beforeFrom = prev(from);
  const HalfedgeId beforeTo = prev(to);
  const HalfedgeId h = addEdge(origin(from), origin(to));
  const HalfedgeId t = twin(h);
  const FaceId added = addFace(kind(kept));
  // from ... beforeTo, t stay in the face; to ... beforeFrom, h are the new one.
  link(beforeTo, t);
  link(t, from);
  link(beforeFrom, h);
  link(h, to);
  set(kFace, t.index(), kept.value);
  set(kFaceHalfedge, kept.index(), t.value);
  set(kFaceHalfedge, added.index(), h.value);
  HalfedgeId e = h;
  do {
    set(kFace, e.index(), added.value);
    e = next(e);
  } while (e != h);
  return h;
}

bool EditMesh::canCollapse(HalfedgeId h) const {
  const HalfedgeId t = twin(h);
  if (!t.valid() || cornerCount(face(h)) != 3 || cornerCount(face(t)) != 3) return false;
  const VertexId a = origin(h);
  const VertexId b = origin(t);
  if (isBoundary(b)) return false;
  const VertexId c = origin(prev(h));
  const VertexId d = origin(prev(t));
  // Every face around b but the two beside h must not contain a, and no neighbour of b but c and d may be one of a.
  bool allowed = c != d;
  forEachOutgoing(b, [&](HalfedgeId out) {
    const FaceId f = face(out);
    const VertexId neighbour = target(out);
    if (neighbour != a && neighbour != c && neighbour != d && connected(a, neighbour)) allowed = false;
    if (f == face(h) || f == face(t)) return;
    for (HalfedgeId e = next(out); e != out; e = next(e)) {
      if (origin(e) == a) allowed = false;
    }
  });
  // A triangle beside the collapsing ones whose three edges would fold onto two: c or d would lose their last face.
  if (allowed) {
    for (const VertexId side : {c, d}) {
      int valence = 0;
      forEachOutgoing(side, [&](HalfedgeId) { ++valence; });
      if (valence <= (isBoundary(side) ? 1 : 3)) allowed = false;
    }
  }
  return allowed;
}

void EditMesh::collapse(HalfedgeId h) {
  const HalfedgeId t = twin(h);
  const VertexId a = origin(h);
  const VertexId b = origin(t);
  const HalfedgeId bc = next(h);
  const HalfedgeId ca = prev(h);
  const HalfedgeId ad = next(t);
  const HalfedgeId db = prev(t);
  const VertexId c = origin(ca);
  const VertexId d = origin(db);
  std::vector<HalfedgeId> fan;
  forEachOutgoing(b, [&](HalfedgeId out) { fan.push_back(out); });
  for (const HalfedgeId out : fan) set(kOrigin, out.index(), a.value);
  const HalfedgeId cb = twin(bc);
  const HalfedgeId ac = twin(ca);
  const HalfedgeId da = twin(ad);
  const HalfedgeId bd = twin(db);
  glue(cb, ac);
  if (!ac.valid() && cb.valid()) set(kTwin, cb.index(), kNone);
  glue(da, bd);
  if (!da.valid() && bd.valid()) set(kTwin, bd.index(), kNone);
  // cb and bd exist, because b is inside.
  if (outgoing(c) == ca) set(kOutgoing, c.index(), cb.value);
  if (outgoing(d) == db) set(kOutgoing, d.index(), da.valid() ? da.value : next(bd).value);
  if (outgoing(a) == h || outgoing(a) == ad) set(kOutgoing, a.index(), bd.value);
  set(kOutgoing, b.index(), kNone);
  setKind(face(h), FaceKind::removed);
  setKind(face(t), FaceKind::removed);
  for (const HalfedgeId e : {h, t, bc, ca, ad, db}) removeHalfedge(e);
}

void EditMesh::rollback(std::size_t mark) {
  while (journal_.size() > mark) {
    const Entry entry = journal_.back();
    journal_.pop_back();
    switch (entry.edit) {
      case Edit::word:
        links_[entry.array][static_cast<std::size_t>(entry.index)] = entry.value;
        break;
      case Edit::vertex:
        vertices_[VertexId(entry.index)] = savedVertices_.back();
        savedVertices_.pop_back();
        break;
      case Edit::newVertex:
        vertices_.raw().pop_back();
        links_[kOutgoing].pop_back();
        break;
      case Edit::newHalfedges:
        for (const Array array : {kNext, kPrev, kTwin, kOrigin, kFace}) {
          links_[array].resize(links_[array].size() - 2);
        }
        break;
      case Edit::newFace:
        links_[kFaceHalfedge].pop_back();
        links_[kFaceKind].pop_back();
        break;
    }
  }
}

}  // namespace qmcf
