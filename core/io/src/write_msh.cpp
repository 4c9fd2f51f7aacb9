// Gmsh MSH 4.1, ASCII: https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format. Faces and edges of the B-rep become
// surfaces and curves, each with a physical group of its own; nodes where curves meet or end become points.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mesh_writers.hpp"
#include "text_writer.hpp"

namespace qmcf {
namespace {

struct Box {
  Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
  Vec3 high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

  void add(const Vec3& p) {
    low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
    high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
  }
};

/// What a curve or surface of the model consists of. Tags are 1 + index; those without elements are not written.
struct Entity {
  Box box;
  std::vector<std::int32_t> boundary;  ///< Indices of points of a curve or of curves of a surface, ascending.
  std::vector<std::int32_t> nodes;     ///< Inside: not on its boundary.
  std::vector<std::size_t> elements;   ///< Elements of a surface, or indices of feature segments of a curve.

  [[nodiscard]] bool isUsed() const { return !elements.empty(); }
};

struct Model {
  std::vector<std::int32_t> points;  ///< Nodes.
  std::vector<Entity> curves;
  std::vector<Entity> surfaces;
};

void sortUnique(std::vector<std::int32_t>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

class ModelBuilder {
 public:
  explicit ModelBuilder(const QuadMesh& mesh)
      : mesh_(mesh),
        nodeCurve_(mesh.positions.size(), kNone),
        segments_(mesh.positions.size(), 0),
        isPoint_(mesh.positions.size(), 0) {}

  Model build() {
    classifyCurves();
    classifyPoints();
    classifySurfaces();
    return std::move(model_);
  }

 private:
  static std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }
  void classifyCurves();
  void classifyPoints();
  void classifySurfaces();
  void boundSurfaces();

  const QuadMesh& mesh_;
  Model model_;
  std::vector<std::int32_t> nodeCurve_;
  std::vector<std::int32_t> segments_;
  std::vector<std::uint8_t> isPoint_;
};

void ModelBuilder::classifyCurves() {
  model_.curves.resize(edgeCount(mesh_));
  for (std::size_t s = 0; s < mesh_.featureSegments.size(); ++s) {
    const FeatureSegment& segment = mesh_.featureSegments[s];
    if (segment.edge < 0) continue;
    Entity& curve = model_.curves[at(segment.edge)];
    curve.elements.push_back(s);
    for (const std::int32_t node : {segment.a, segment.b}) {
      curve.box.add(mesh_.positions[at(node)]);
      if (nodeCurve_[at(node)] != kNone && nodeCurve_[at(node)] != segment.edge) isPoint_[at(node)] = 1;
      nodeCurve_[at(node)] = segment.edge;
      ++segments_[at(node)];
    }
  }
}

void ModelBuilder::classifyPoints() {
  std::vector<std::int32_t> pointOf(mesh_.positions.size(), kNone);
  for (std::size_t node = 0; node < mesh_.positions.size(); ++node) {
    if (nodeCurve_[node] == kNone) continue;
    if (isPoint_[node] != 0 || segments_[node] != 2) {
      pointOf[node] = static_cast<std::int32_t>(model_.points.size());
      model_.points.push_back(static_cast<std::int32_t>(node));
    } else {
      model_.curves[at(nodeCurve_[node])].nodes.push_back(static_cast<std::int32_t>(node));
    }
  }
  for (Entity& curve : model_.curves) {
    for (const std::size_t s : curve.elements) {
      const FeatureSegment& segment = mesh_.featureSegments[s];
      for (const std::int32_t node : {segment.a, segment.b}) {
        if (pointOf[at(node)] != kNone) curve.boundary.push_back(pointOf[at(node)]);
      }
    }
    sortUnique(curve.boundary);
  }
}

void ModelBuilder::classifySurfaces() {
  model_.surfaces.resize(faceCount(mesh_));
  std::vector<std::int32_t> nodeSurface(mesh_.positions.size(), mesh_.elements.empty() ? kNone : faceOf(mesh_, 0));
  for (std::size_t e = mesh_.elements.size(); e-- > 0;) {
    const std::int32_t face = faceOf(mesh_, e);
    for (std::size_t c = 0; c < cornerCount(mesh_.elements[e]); ++c) nodeSurface[at(mesh_.elements[e][c])] = face;
  }
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
    Entity& surface = model_.surfaces[at(faceOf(mesh_, e))];
    surface.elements.push_back(e);
    for (std::size_t c = 0; c < cornerCount(mesh_.elements[e]); ++c) {
      surface.box.add(mesh_.positions[at(mesh_.elements[e][c])]);
    }
  }
  for (std::size_t node = 0; node < mesh_.positions.size(); ++node) {
    if (nodeCurve_[node] != kNone || nodeSurface[node] == kNone) continue;
    model_.surfaces[at(nodeSurface[node])].nodes.push_back(static_cast<std::int32_t>(node));
  }
  boundSurfaces();
}

/// A surface is bounded by the curves whose segments are sides of its elements.
void ModelBuilder::boundSurfaces() {
  using Side = std::pair<std::int32_t, std::int32_t>;
  std::vector<std::pair<Side, std::int32_t>> sides;
  for (const FeatureSegment& segment : mesh_.featureSegments) {
    if (segment.edge >= 0) sides.push_back({std::minmax({segment.a, segment.b}), segment.edge});
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
    const Element& element = mesh_.elements[e];
    const std::size_t corners = cornerCount(element);
    for (std::size_t c = 0; c < corners; ++c) {
      const Side side = std::minmax({element[c], element[(c + 1) % corners]});
      const auto found = std::lower_bound(sides.begin(), sides.end(), std::make_pair(side, kNone));
      if (found != sides.end() && found->first == side) {
        model_.surfaces[at(faceOf(mesh_, e))].boundary.push_back(found->second);
      }
    }
  }
  for (Entity& surface : model_.surfaces) sortUnique(surface.boundary);
}

std::size_t usedCount(const std::vector<Entity>& entities) {
  return static_cast<std::size_t>(
      std::count_if(entities.begin(), entities.end(), [](const Entity& e) { return e.isUsed(); }));
}

void writePhysicalNames(TextWriter& out, const Model& model, const GroupNames& names) {
  out << "$PhysicalNames\n" << usedCount(model.curves) + usedCount(model.surfaces) << '\n';
  for (std::size_t i = 0; i < model.curves.size(); ++i) {
    if (model.curves[i].isUsed()) out << "1 " << i + 1 << " \"" << names.edges[i] << "\"\n";
  }
  for (std::size_t i = 0; i < model.surfaces.size(); ++i) {
    if (model.surfaces[i].isUsed()) out << "2 " << i + 1 << " \"" << names.faces[i] << "\"\n";
  }
  out << "$EndPhysicalNames\n";
}

void writeEntities(TextWriter& out, const QuadMesh& mesh, const Model& model) {
  out << "$Entities\n"
      << model.points.size() << ' ' << usedCount(model.curves) << ' ' << usedCount(model.surfaces) << " 0\n";
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    out << i + 1 << ' ' << mesh.positions[static_cast<std::size_t>(model.points[i])] << " 0\n";
  }
  for (const std::vector<Entity>* entities : {&model.curves, &model.surfaces}) {
    for (std::size_t i = 0; i < entities->size(); ++i) {
      const Entity& entity = (*entities)[i];
      if (!entity.isUsed()) continue;
      out << i + 1 << ' ' << entity.box.low << ' ' << entity.box.high << " 1 " << i + 1 << ' '
          << entity.boundary.size();
      for (const std::int32_t part : entity.boundary) out << ' ' << part + 1;
      out << '\n';
    }
  }
  out << "$EndEntities\n";
}

void writeNodeBlock(TextWriter& out, const QuadMesh& mesh, int dimension, std::size_t entity,
                    const std::vector<std::int32_t>& nodes) {
  if (nodes.empty()) return;
  out << dimension << ' ' << entity + 1 << " 0 " << nodes.size() << '\n';
  for (const std::int32_t node : nodes) out << node + 1 << '\n';
  for (const std::int32_t node : nodes) out << mesh.positions[static_cast<std::size_t>(node)] << '\n';
}

void writeNodes(TextWriter& out, const QuadMesh& mesh, const Model& model) {
  const auto hasNodes = [](const Entity& entity) { return !entity.nodes.empty(); };
  const auto blocks = static_cast<std::ptrdiff_t>(model.points.size()) +
                      std::count_if(model.curves.begin(), model.curves.end(), hasNodes) +
                      std::count_if(model.surfaces.begin(), model.surfaces.end(), hasNodes);
  out << "$Nodes\n" << blocks << ' ' << mesh.positions.size() << " 1 " << mesh.positions.size() << '\n';
  for (std::size_t i = 0; i < model.points.size(); ++i) writeNodeBlock(out, mesh, 0, i, {model.points[i]});
  for (std::size_t i = 0; i < model.curves.size(); ++i) writeNodeBlock(out, mesh, 1, i, model.curves[i].nodes);
  for (std::size_t i = 0; i < model.surfaces.size(); ++i) writeNodeBlock(out, mesh, 2, i, model.surfaces[i].nodes);
  out << "$EndNodes\n";
}

/// Elements of one surface with the given number of corners; none: nothing.
void writeElementBlock(TextWriter& out, const QuadMesh& mesh, std::size_t surface, const Entity& entity,
                       std::size_t corners) {
  const auto fits = [&](std::size_t e) { return cornerCount(mesh.elements[e]) == corners; };
  const auto count = std::count_if(entity.elements.begin(), entity.elements.end(), fits);
  if (count == 0) return;
  out << "2 " << surface + 1 << (corners == 3 ? " 2 " : " 3 ") << count << '\n';
  for (const std::size_t e : entity.elements) {
    if (!fits(e)) continue;
    out << e + 1;
    for (std::size_t c = 0; c < corners; ++c) out << ' ' << mesh.elements[e][c] + 1;
    out << '\n';
  }
}

void writeElements(TextWriter& out, const QuadMesh& mesh, const Model& model) {
  std::size_t blocks = usedCount(model.curves);
  std::size_t lines = 0;
  for (const Entity& curve : model.curves) lines += curve.elements.size();
  for (const Entity& surface : model.surfaces) {
    for (const std::size_t corners : {std::size_t{3}, std::size_t{4}}) {
      const auto fits = [&](std::size_t e) { return cornerCount(mesh.elements[e]) == corners; };
      if (std::any_of(surface.elements.begin(), surface.elements.end(), fits)) ++blocks;
    }
  }
  const std::size_t count = mesh.elements.size() + lines;
  out << "$Elements\n" << blocks << ' ' << count << " 1 " << count << '\n';
  std::size_t tag = mesh.elements.size();
  for (std::size_t i = 0; i < model.curves.size(); ++i) {
    if (!model.curves[i].isUsed()) continue;
    out << "1 " << i + 1 << " 1 " << model.curves[i].elements.size() << '\n';
    for (const std::size_t s : model.curves[i].elements) {
      out << ++tag << ' ' << mesh.featureSegments[s].a + 1 << ' ' << mesh.featureSegments[s].b + 1 << '\n';
    }
  }
  for (std::size_t i = 0; i < model.surfaces.size(); ++i) {
    writeElementBlock(out, mesh, i, model.surfaces[i], 3);
    writeElementBlock(out, mesh, i, model.surfaces[i], 4);
  }
  out << "$EndElements\n";
}

}  // namespace

std::string writeMsh(const QuadMesh& mesh, const WriteOptions& options) {
  const Model model = ModelBuilder(mesh).build();
  TextWriter out;
  out.reserve(mesh.positions.size() * 70 + mesh.elements.size() * 40);
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  writePhysicalNames(out, model, groupNames(mesh, options, NameRule::quotedText));
  writeEntities(out, mesh, model);
  writeNodes(out, mesh, model);
  writeElements(out, mesh, model);
  return out.take();
}

}  // namespace qmcf
