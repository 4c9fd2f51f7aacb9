#include "report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace qmcf::cli {
namespace {

constexpr std::size_t kMostLines = 20;

std::string line(std::string label, const std::string& text) {
  constexpr std::size_t kLabelWidth = 10;
  label.resize(std::max(kLabelWidth, label.size() + 1), ' ');
  return label + text + "\n";
}

std::string percent(double share) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f %%", 100.0 * share);
  return text.data();
}

/// "duplicateVertices" becomes "duplicate vertices".
std::string words(const std::string& identifier) {
  std::string result;
  for (const char c : identifier) {
    const bool isUpper = c >= 'A' && c <= 'Z';
    if (isUpper) result += ' ';
    result += isUpper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

std::string join(const std::vector<std::string>& parts) {
  std::string result;
  for (const std::string& part : parts) result += (result.empty() ? "" : ", ") + part;
  return result;
}

/// The first few ids.
std::string idList(const std::vector<std::int64_t>& ids) {
  constexpr std::size_t kMostIds = 12;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(ids.size(), kMostIds); ++i) parts.push_back(std::to_string(ids[i]));
  if (ids.size() > kMostIds) parts.emplace_back("...");
  return join(parts);
}

std::string edgeCounts(const Brep& brep) {
  std::vector<std::string> parts;
  constexpr std::array<std::pair<EdgeKind, const char*>, 4> kKinds{{{EdgeKind::sharp, "sharp"},
                                                                    {EdgeKind::boundary, "boundary"},
                                                                    {EdgeKind::nonManifold, "non-manifold"},
                                                                    {EdgeKind::label, "label"}}};
  for (const auto& [kind, name] : kKinds) {
    const auto count = std::count_if(brep.edges.begin(), brep.edges.end(),
                                     [kindWanted = kind](const BrepEdge& edge) { return edge.kind == kindWanted; });
    if (count > 0) parts.push_back(std::to_string(count) + " " + name);
  }
  const std::string total = counted(static_cast<std::int64_t>(brep.edges.size()), "edge", "edges");
  return parts.empty() ? total : total + " (" + join(parts) + ")";
}

std::string distributionText(const Distribution& distribution) {
  if (std::isnan(distribution.mean)) return "of no quadrilateral";
  std::string text = "mean " + shortNumber(distribution.mean) + ", worst 1 % beyond " + shortNumber(distribution.p1) +
                     ", worst " + shortNumber(distribution.worst);
  if (distribution.infinite > 0) text += ", infinite " + std::to_string(distribution.infinite);
  return text;
}

/// "12 (14 of 3, 2 of 5)": what irregular vertices are worth, and how many have how many elements.
std::string indexText(std::int64_t index, const std::vector<LedgerEntry>& entries) {
  std::vector<std::string> kinds;
  for (const LedgerEntry& entry : entries) {
    kinds.push_back(std::to_string(entry.vertices) + " of " + std::to_string(entry.elements));
  }
  return std::to_string(index) + (kinds.empty() ? "" : " (" + join(kinds) + ")");
}

std::string ledgerText(const IndexLedger& ledger) {
  std::string text = "irregular vertices " + indexText(ledger.interiorIndex, ledger.interior) + ", boundary " +
                     indexText(ledger.boundaryIndex, ledger.boundary) + ", triangles " +
                     std::to_string(ledger.triangles) + ", in all " + std::to_string(ledger.sum()) +
                     "; four times the Euler characteristic " + std::to_string(ledger.fourEuler);
  if (ledger.partFourEuler && *ledger.partFourEuler != ledger.fourEuler) {
    text += ", of the part " + std::to_string(*ledger.partFourEuler);
  }
  return line("Ledger", text);
}

std::string fidelityText(const QualityReport& report, bool hasCreases) {
  std::string text;
  if (report.largestDistance)
    text += line("Distance", "largest " + shortNumber(*report.largestDistance) + " from the part");
  std::vector<std::string> kept;
  const auto add = [&](const std::optional<double>& recall, const char* what) {
    if (recall) kept.push_back(percent(*recall) + " of " + what);
  };
  if (hasCreases) add(report.sharpRecall, "sharp edges");
  add(report.boundaryRecall, "boundary");
  add(report.nonManifoldRecall, "non-manifold edges");
  if (hasCreases) add(report.cornerRecall, "corners");
  if (!kept.empty()) text += line("Kept", join(kept));
  if (!hasCreases && report.sharpRecall) {
    text += line("", "no creases: where triangles meet at more than the feature angle, that is taken as curvature");
  }
  return text;
}

}  // namespace

std::string shortNumber(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string counted(std::int64_t count, const std::string& singular, const std::string& plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

std::string modelText(const std::string& path, const ReadModel& model) {
  const auto triangles = static_cast<std::int64_t>(model.mesh.triangles.size());
  std::string text = path + ": " + std::string(inputFormatName(model.format)) + ", " +
                     counted(static_cast<std::int64_t>(model.mesh.positions.size()), "vertex", "vertices") + ", " +
                     counted(model.polygons, "face", "faces");
  if (triangles != model.polygons) text += " cut into " + counted(triangles, "triangle", "triangles");
  if (!model.mesh.labelNames.empty()) {
    text += ", " + counted(static_cast<std::int64_t>(model.mesh.labelNames.size()), "group", "groups");
  }
  std::string result = line("Read", text);
  if (model.skippedFaces > 0) {
    result +=
        line("", counted(model.skippedFaces, "face has", "faces have") + " fewer than three corners and were left out");
  }
  return result;
}

std::string statisticsText(const MeshStatistics& statistics) {
  const std::pair<std::int64_t, std::array<const char*, 2>> kCounts[] = {
      {statistics.components, {"component", "components"}},
      {statistics.boundaryLoops, {"boundary loop", "boundary loops"}},
      {statistics.nonManifoldEdges, {"non-manifold edge", "non-manifold edges"}},
      {statistics.nonManifoldVertices, {"non-manifold vertex", "non-manifold vertices"}},
      {statistics.misorientedEdges, {"misoriented edge", "misoriented edges"}},
      {statistics.degenerateTriangles, {"degenerate triangle", "degenerate triangles"}},
      {statistics.sliverTriangles, {"sliver", "slivers"}},
      {statistics.duplicateVertices, {"duplicate vertex", "duplicate vertices"}},
      {statistics.duplicateTriangles, {"duplicate triangle", "duplicate triangles"}},
      {statistics.unusedVertices, {"unused vertex", "unused vertices"}}};
  std::vector<std::string> parts;
  for (const auto& [count, words] : kCounts) {
    if (count > 0) parts.push_back(counted(count, words[0], words[1]));
  }
  return line("As read", join(parts) + ", " + shortNumber(statistics.diagonal) + " across");
}

std::string partText(const InspectResult& result) {
  std::string text;
  for (const RepairItem& item : result.repaired.items) {
    text += line(item.action == "found" ? "Defect" : "Repair",
                 words(item.defect) + ": " + std::to_string(item.count) + " " + item.action);
  }
  const Brep& brep = result.brep;
  std::int64_t loops = 0;
  for (const BrepFace& face : brep.faces) loops += static_cast<std::int64_t>(face.loops.size());
  const auto closed = std::count_if(brep.bodies.begin(), brep.bodies.end(), [](const BrepBody& b) { return b.closed; });
  return text + line("Part", counted(static_cast<std::int64_t>(brep.bodies.size()), "body", "bodies") + " (" +
                                 std::to_string(closed) + " closed), " +
                                 counted(static_cast<std::int64_t>(brep.faces.size()), "face", "faces") + ", " +
                                 counted(loops, "loop", "loops") + ", " + edgeCounts(brep) + ", " +
                                 counted(static_cast<std::int64_t>(brep.vertices.size()), "vertex", "vertices"));
}

std::string elementsText(const Brep& brep) {
  std::string text;
  for (std::size_t f = 0; f < brep.faces.size(); ++f) {
    const BrepFace& face = brep.faces[f];
    text += line("Face " + std::to_string(f),
                 "\"" + face.name + "\", body " + std::to_string(face.body) + ", area " + shortNumber(face.area) +
                     ", " + counted(static_cast<std::int64_t>(face.triangles.size()), "triangle", "triangles") + ", " +
                     counted(static_cast<std::int64_t>(face.loops.size()), "loop", "loops"));
  }
  for (std::size_t e = 0; e < brep.edges.size(); ++e) {
    const BrepEdge& edge = brep.edges[e];
    text += line(
        "Edge " + std::to_string(e),
        words(std::string(edgeKindName(edge.kind))) + ", length " + shortNumber(edge.length) + ", " +
            (edge.start == edge.end ? "closed at vertex " + std::to_string(edge.start)
                                    : "vertices " + std::to_string(edge.start) + " to " + std::to_string(edge.end)));
  }
  return text;
}

std::string meshText(const MeshResult& result) {
  const QualityReport& quality = result.quality;
  std::string text = line(
      "Mesh", counted(quality.quads, "quad", "quads") + " and " + counted(quality.triangles, "triangle", "triangles") +
                  " (" + percent(quality.quadShare) + " quads), element size " + shortNumber(result.size) + ", " +
                  counted(result.fieldSingularities, "field singularity", "field singularities"));
  std::vector<std::pair<std::string, std::int64_t>> methods;
  std::size_t fallbacks = 0;
  std::string reasons;
  for (const FaceReport& face : result.faces) {
    const auto known =
        std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.first == face.method; });
    if (known == methods.end()) {
      methods.emplace_back(face.method, 1);
    } else {
      ++known->second;
    }
    if (face.reason.empty() || ++fallbacks > kMostLines) continue;
    reasons += line("", "face " + std::to_string(face.face) + " as " + face.method + ": " + face.reason);
  }
  if (fallbacks > kMostLines) reasons += line("", "... and " + std::to_string(fallbacks - kMostLines) + " more");
  std::vector<std::string> parts;
  for (const auto& [method, count] : methods) parts.push_back(std::to_string(count) + " by " + method);
  if (result.elementsCut) {
    reasons +=
        line("", "elements of twice the size, each cut up: with paired triangles there was no whole, valid mesh");
  }
  if (result.fittedSizes) reasons += line("", "sizes vary to fit the cross field");
  if (result.sizing.bySizes > 0) {
    reasons += line("", "sizes asked for at " + counted(result.sizing.bySizes, "vertex", "vertices") + " of the part");
  }
  if (result.sizing.byCurvature > 0) {
    reasons +=
        line("", "smaller elements for the chord error at " + counted(result.sizing.byCurvature, "vertex", "vertices") +
                     " of the part, " + std::to_string(result.sizing.floored) + " of them at a tenth of the size");
  }
  if (result.refinedPlaces > 0) {
    const std::string places = counted(result.refinedPlaces, "place", "places");
    reasons += line("", "smaller elements at " + places + " that elements of the size could not follow");
  }
  if (result.heldFaces > 0) {
    const std::string held = counted(result.heldFaces, "face keeps its nodes", "faces keep their nodes");
    reasons += line("", held + ": moved along their edges they would make the mesh invalid");
  }
  if (result.heldPlaces > 0) {
    const std::string held = counted(result.heldPlaces, "place keeps its vertices", "places keep their vertices");
    reasons += line("", held + ": relaxed with the others they would make the mesh invalid");
  }
  return text + line("Faces", join(parts)) + reasons;
}

bool hasCreases(const Brep& brep) {
  return std::any_of(brep.edges.begin(), brep.edges.end(),
                     [](const BrepEdge& edge) { return edge.kind == EdgeKind::sharp; });
}

std::string qualityText(const QualityReport& report, bool hasCreases) {
  std::string text =
      line("Shape", "scaled Jacobian " + distributionText(report.scaledJacobian)) +
      line("", "smallest angle " + distributionText(report.minAngle)) +
      line("", "aspect ratio " + distributionText(report.aspectRatio)) +
      line("", report.regularShare ? percent(*report.regularShare) + " of the interior vertices are regular"
                                   : "no interior vertices") +
      ledgerText(report.ledger) + fidelityText(report, hasCreases);
  std::int64_t passed = 0;
  for (const ValidityCheck& check : report.checks) {
    passed += check.status == CheckStatus::pass ? 1 : 0;
    const bool matters = check.status == CheckStatus::warn || check.status == CheckStatus::fail;
    if (!matters) continue;
    text += line(std::string(checkStatusName(check.status)), words(check.name) + ": " + check.sentence);
    if (!check.elements.empty()) text += line("", idList(check.elements));
  }
  return text + line(report.valid ? "Valid" : "INVALID",
                     std::to_string(passed) + " of " + std::to_string(report.checks.size()) + " checks passed");
}

}  // namespace qmcf::cli
