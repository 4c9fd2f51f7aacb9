#include "qmcf/pipeline/report_json.hpp"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

namespace qmcf {
namespace {

// Keeps the order in which the fields are set. Non-finite numbers are dumped as null.
using Json = nlohmann::ordered_json;

/// Compact, and valid UTF-8 whatever the names hold.
std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json toValue(const Distribution& distribution) {
  return {{"mean", distribution.mean},
          {"worst", distribution.worst},
          {"p1", distribution.p1},
          {"median", distribution.median},
          {"infinite", distribution.infinite}};
}

Json toValue(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

Json toValue(const LedgerEntry& entry) {
  return {{"elements", entry.elements}, {"vertices", entry.vertices}, {"index", entry.index}};
}

Json toValue(const SizeConformity& sizes) {
  return {{"meanAbsLog2", sizes.meanAbsLog2},
          {"p5", sizes.p5},
          {"median", sizes.median},
          {"p95", sizes.p95},
          {"withinSqrt2", sizes.withinSqrt2}};
}

Json toValue(const SizeSources& sources) {
  return {{"bySizes", sources.bySizes}, {"byCurvature", sources.byCurvature}, {"floored", sources.floored}};
}

Json toValue(const ValidityCheck& check) {
  constexpr std::size_t kMostIds = 100;
  const auto end = check.elements.begin() + static_cast<std::ptrdiff_t>(std::min(check.elements.size(), kMostIds));
  return {{"name", check.name},
          {"status", checkStatusName(check.status)},
          {"count", check.count},
          {"elements", std::vector<std::int64_t>(check.elements.begin(), end)},
          {"sentence", check.sentence}};
}

Json toValue(const RepairItem& item) {
  return {{"defect", item.defect}, {"action", item.action}, {"count", item.count}, {"elements", item.elements}};
}

Json toValue(const FaceReport& face) {
  return {{"face", face.face},
          {"method", face.method},
          {"reason", face.reason},
          {"quads", face.quads},
          {"triangles", face.triangles}};
}

Json toValue(const BrepBody& body) { return {{"closed", body.closed}, {"faces", body.faces}}; }

Json toValue(const BrepLoop& loop) {
  Json coedges = Json::array();
  for (const Coedge& coedge : loop.coedges) {
    coedges.push_back({{"edge", coedge.edge}, {"reversed", coedge.reversed}, {"cornerQuads", coedge.cornerQuads}});
  }
  return coedges;
}

Json toValue(const BrepFace& face) {
  Json loops = Json::array();
  for (const BrepLoop& loop : face.loops) loops.push_back(toValue(loop));
  return {{"name", face.name},
          {"body", face.body},
          {"triangles", face.triangles.size()},
          {"area", face.area},
          {"loops", loops}};
}

Json toValue(const BrepEdge& edge) {
  return {{"kind", edgeKindName(edge.kind)},
          {"start", edge.start},
          {"end", edge.end},
          {"points", edge.points.size()},
          {"length", edge.length}};
}

Json toValue(const BrepVertex& vertex) { return {{"point", vertex.point}, {"artificial", vertex.artificial}}; }

template <class T>
Json toArray(const std::vector<T>& values) {
  Json array = Json::array();
  for (const T& value : values) array.push_back(toValue(value));
  return array;
}

Json toValue(const IndexLedger& ledger) {
  return {{"interior", toArray(ledger.interior)},
          {"boundary", toArray(ledger.boundary)},
          {"interiorIndex", ledger.interiorIndex},
          {"boundaryIndex", ledger.boundaryIndex},
          {"triangles", ledger.triangles},
          {"sum", ledger.sum()},
          {"sheets", ledger.sheets},
          {"fourEuler", ledger.fourEuler},
          {"partFourEuler", ledger.partFourEuler ? Json(*ledger.partFourEuler) : Json(nullptr)},
          {"closes", ledger.closes()}};
}

Json counts(const InspectResult& result) {
  const Brep& brep = result.brep;
  std::size_t loops = 0;
  for (const BrepFace& face : brep.faces) loops += face.loops.size();
  Json edges = {{"total", brep.edges.size()}};
  for (const EdgeKind kind : {EdgeKind::nonManifold, EdgeKind::boundary, EdgeKind::sharp, EdgeKind::label}) {
    edges[std::string(edgeKindName(kind))] =
        std::count_if(brep.edges.begin(), brep.edges.end(), [&](const BrepEdge& edge) { return edge.kind == kind; });
  }
  return {{"points", result.repaired.mesh.positions.size()},
          {"triangles", result.repaired.mesh.triangles.size()},
          {"bodies", brep.bodies.size()},
          {"faces", brep.faces.size()},
          {"loops", loops},
          {"edges", edges},
          {"vertices", brep.vertices.size()}};
}

void addFidelity(Json& json, const QualityReport& report) {
  json["meanDistance"] = toValue(report.meanDistance);
  json["largestDistance"] = toValue(report.largestDistance);
  json["largestGap"] = toValue(report.largestGap);
  json["missed"] = Json::array();
  for (const Vec3& place : report.missed) json["missed"].push_back({place.x, place.y, place.z});
  json["sharpRecall"] = toValue(report.sharpRecall);
  json["boundaryRecall"] = toValue(report.boundaryRecall);
  json["nonManifoldRecall"] = toValue(report.nonManifoldRecall);
  json["cornerRecall"] = toValue(report.cornerRecall);
}

Json toValue(const QualityReport& report) {
  Json json = {{"vertices", report.vertices},
               {"quads", report.quads},
               {"triangles", report.triangles},
               {"quadShare", report.quadShare},
               {"regularShare", toValue(report.regularShare)},
               {"interiorVertices", report.interiorVertices},
               {"irregularVertices", report.irregularVertices},
               {"doublets", report.doublets},
               {"boundaryEdges", report.boundaryEdges},
               {"components", report.components},
               {"eulerCharacteristic", report.eulerCharacteristic},
               {"ledger", toValue(report.ledger)},
               {"area", report.area},
               {"scaledJacobian", toValue(report.scaledJacobian)},
               {"jacobianRatio", toValue(report.jacobianRatio)},
               {"jacobianRatioGauss", toValue(report.jacobianRatioGauss)},
               {"aspectRatio", toValue(report.aspectRatio)},
               {"edgeRatio", toValue(report.edgeRatio)},
               {"orthogonalQuality", toValue(report.orthogonalQuality)},
               {"minAngle", toValue(report.minAngle)},
               {"maxAngle", toValue(report.maxAngle)},
               {"skewness", toValue(report.skewness)},
               {"warpage", toValue(report.warpage)},
               {"triangleScaledJacobian", toValue(report.triangleScaledJacobian)},
               {"size", report.size},
               {"sizeError", report.sizeError}};
  addFidelity(json, report);
  json["checks"] = toArray(report.checks);
  json["valid"] = report.valid;
  return json;
}

}  // namespace

std::string toJson(const QualityReport& report) { return dump(toValue(report)); }

std::string toJson(const InspectResult& result) {
  const Brep& brep = result.brep;
  return dump({{"repair", toArray(result.repaired.items)},
               {"counts", counts(result)},
               {"bodies", toArray(brep.bodies)},
               {"faces", toArray(brep.faces)},
               {"edges", toArray(brep.edges)},
               {"vertices", toArray(brep.vertices)}});
}

std::string toJson(const MeshResult& result) {
  return dump({{"size", result.size},
               {"quality", toValue(result.quality)},
               {"faces", toArray(result.faces)},
               {"repair", toArray(result.input.repaired.items)},
               {"fieldSingularities", result.fieldSingularities},
               {"refinedPlaces", result.refinedPlaces},
               {"heldFaces", result.heldFaces},
               {"heldPlaces", result.heldPlaces},
               {"slidNodes", result.slidNodes},
               {"elementsCut", result.elementsCut},
               {"fittedSizes", result.fittedSizes},
               {"sizing", toValue(result.sizing)},
               {"sizeConformity", toValue(result.sizeConformity)}});
}

}  // namespace qmcf
