// Input of finite element solvers: Abaqus and CalculiX INP, Nastran BDF. Only the mesh and its sets: materials,
// sections and loads are the user's.

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "mesh_writers.hpp"
#include "text_writer.hpp"

namespace qmcf {
namespace {

/// The number with as many digits as fit into `width` characters, with a decimal point as both formats demand.
/// INP allows 20 characters; Nastran's large fields 16, where the exponent needs no letter.
std::string fittedNumber(double value, std::size_t width, bool exponentLetter) {
  std::array<char, 40> digits{};
  const auto text = [&](int precision) {
    if (precision >= 0) std::snprintf(digits.data(), digits.size(), "%.*e", precision, value);
    std::string result = precision < 0 ? shortText(value) : std::string(digits.data());
    const std::size_t exponent = result.find('e');
    const std::size_t point = result.find('.');
    if (point == std::string::npos) result.insert(std::min(exponent, result.size()), ".");
    const std::size_t letter = result.find('e');
    if (letter != std::string::npos) {
      if (result[letter + 2] == '0') result.erase(letter + 2, 1);
      if (exponentLetter) {
        result[letter] = 'E';
      } else {
        result.erase(letter, 1);
      }
    }
    return result;
  };
  std::string result = text(-1);
  for (int precision = 16; result.size() > width && precision >= 0; --precision) result = text(precision);
  return result;
}

std::vector<std::int32_t> nodesOf(const std::vector<FeatureSegment>& segments) {
  std::vector<std::int32_t> nodes;
  for (const FeatureSegment& segment : segments) nodes.insert(nodes.end(), {segment.a, segment.b});
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void writeInpElements(TextWriter& out, const QuadMesh& mesh, const std::vector<std::size_t>& elements,
                      std::size_t corners, const std::string& set) {
  bool first = true;
  for (const std::size_t e : elements) {
    if (cornerCount(mesh.elements[e]) != corners) continue;
    if (first) out << "*ELEMENT, TYPE=S" << corners << ", ELSET=" << set << '\n';
    first = false;
    out << e + 1;
    for (std::size_t c = 0; c < corners; ++c) out << ", " << mesh.elements[e][c] + 1;
    out << '\n';
  }
}

std::vector<std::vector<std::size_t>> elementsByFace(const QuadMesh& mesh) {
  std::vector<std::vector<std::size_t>> faces(faceCount(mesh));
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) faces[static_cast<std::size_t>(faceOf(mesh, e))].push_back(e);
  return faces;
}

/// Right-aligned in a field.
void writeField(TextWriter& out, std::string_view text, std::size_t width) {
  for (std::size_t i = text.size(); i < width; ++i) out << ' ';
  out << text;
}

/// "SET n = 1,2,3", in lines of at most 72 characters.
void writeNastranSet(TextWriter& out, std::size_t number, const std::vector<std::int32_t>& nodes) {
  constexpr std::size_t kLineLength = 72;
  std::string line = "SET " + std::to_string(number) + " = ";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::string item = std::to_string(nodes[i] + 1) + (i + 1 < nodes.size() ? "," : "");
    if (line.size() + item.size() > kLineLength) {
      out << line << '\n';
      line = "  ";
    }
    line += item;
  }
  out << line << '\n';
}

void writeNastranGrid(TextWriter& out, std::size_t number, const Vec3& point) {
  constexpr std::size_t kWide = 16;
  out << "GRID*   ";
  writeField(out, std::to_string(number), kWide);
  writeField(out, "", kWide);
  writeField(out, fittedNumber(point.x, kWide, false), kWide);
  writeField(out, fittedNumber(point.y, kWide, false), kWide);
  out << "*\n*       ";
  writeField(out, fittedNumber(point.z, kWide, false), kWide);
  out << '\n';
}

}  // namespace

std::string writeInp(const QuadMesh& mesh, const WriteOptions& options) {
  const GroupNames names = groupNames(mesh, options, NameRule::identifier);
  constexpr std::size_t kNumberWidth = 20;
  TextWriter out;
  out.reserve(mesh.positions.size() * 75 + mesh.elements.size() * 40);
  out << "*HEADING\nQuad-dominant mesh by QMCF\n*NODE\n";
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& point = mesh.positions[v];
    out << v + 1;
    for (const double value : {point.x, point.y, point.z}) out << ", " << fittedNumber(value, kNumberWidth, true);
    out << '\n';
  }
  const auto faces = elementsByFace(mesh);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    writeInpElements(out, mesh, faces[f], 4, names.faces[f]);
    writeInpElements(out, mesh, faces[f], 3, names.faces[f]);
  }
  const auto edges = segmentsByEdge(mesh);
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    const std::vector<std::int32_t> nodes = nodesOf(edges[edge]);
    if (nodes.empty()) continue;
    constexpr std::size_t kPerLine = 16;
    out << "*NSET, NSET=" << names.edges[edge];
    for (std::size_t i = 0; i < nodes.size(); ++i) out << (i % kPerLine == 0 ? "\n" : ", ") << nodes[i] + 1;
    out << '\n';
  }
  return out.take();
}

std::string writeBdf(const QuadMesh& mesh, const WriteOptions& options) {
  const GroupNames names = groupNames(mesh, options, NameRule::identifier);
  constexpr std::size_t kNarrow = 8;
  TextWriter out;
  out.reserve(mesh.positions.size() * 110 + mesh.elements.size() * 60);
  out << "$ Quad-dominant mesh by QMCF\n$ Faces are property numbers, edges are sets of grid points.\nSOL 101\nCEND\n";
  const auto edges = segmentsByEdge(mesh);
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    if (edges[edge].empty()) continue;
    out << "$ Set " << edge + 1 << ": " << names.edges[edge] << '\n';
    writeNastranSet(out, edge + 1, nodesOf(edges[edge]));
  }
  out << "BEGIN BULK\n";
  for (std::size_t f = 0; f < names.faces.size(); ++f) out << "$ Property " << f + 1 << ": " << names.faces[f] << '\n';
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) writeNastranGrid(out, v + 1, mesh.positions[v]);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::size_t corners = cornerCount(mesh.elements[e]);
    out << (corners == 3 ? "CTRIA3  " : "CQUAD4  ");
    writeField(out, std::to_string(e + 1), kNarrow);
    writeField(out, std::to_string(faceOf(mesh, e) + 1), kNarrow);
    for (std::size_t c = 0; c < corners; ++c) writeField(out, std::to_string(mesh.elements[e][c] + 1), kNarrow);
    out << '\n';
  }
  out << "ENDDATA\n";
  return out.take();
}

}  // namespace qmcf
