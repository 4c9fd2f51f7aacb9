// Input of finite element solvers: Abaqus and CalculiX INP, Nastran BDF. Only the mesh and its sets: materials,
// sections and loads are the user's.

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_writers.hpp"
#include "text_writer.hpp"

namespace qmcf {
namespace {

/// A decimal number: 0.d1 d2 d3... times ten to the power of `point`.
struct Decimal {
  bool negative = false;
  std::string digits;  ///< Without zeros at either end; "0" for zero.
  int point = 0;
};

Decimal decimalOf(double value) {
  Decimal decimal;
  int exponent = 0;
  bool behindPoint = false;
  const std::string text = shortText(value);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == 'e') {
      exponent = std::atoi(text.c_str() + i + 1);
      break;
    }
    decimal.negative = decimal.negative || c == '-';
    behindPoint = behindPoint || c == '.';
    if (c < '0' || c > '9') continue;
    if (!decimal.digits.empty() || c != '0') decimal.digits += c;
    const bool leadingZero = decimal.digits.empty();
    if (!behindPoint && !leadingZero) ++decimal.point;
    if (behindPoint && leadingZero) --decimal.point;
  }
  decimal.point += exponent;
  decimal.digits.erase(decimal.digits.find_last_not_of('0') + 1);
  if (decimal.digits.empty()) return {decimal.negative, "0", 1};
  return decimal;
}

Decimal rounded(Decimal decimal, std::size_t count) {
  if (count >= decimal.digits.size()) return decimal;
  const bool up = decimal.digits[count] >= '5';
  decimal.digits.resize(count);
  if (up) {
    while (!decimal.digits.empty() && decimal.digits.back() == '9') decimal.digits.pop_back();
    if (decimal.digits.empty()) return {decimal.negative, "1", decimal.point + 1};
    ++decimal.digits.back();
  }
  decimal.digits.erase(decimal.digits.find_last_not_of('0') + 1);
  return decimal;
}

/// Without an exponent.
std::string plainText(const Decimal& decimal) {
  const auto count = static_cast<int>(decimal.digits.size());
  std::string text = decimal.digits;
  if (decimal.point <= 0) {
    text = "0." + std::string(static_cast<std::size_t>(-decimal.point), '0') + text;
  } else if (decimal.point >= count) {
    text += std::string(static_cast<std::size_t>(decimal.point - count), '0') + ".";
  } else {
    text.insert(static_cast<std::size_t>(decimal.point), ".");
  }
  return (decimal.negative ? "-" : "") + text;
}

std::string exponentText(const Decimal& decimal, std::string_view letter) {
  const int exponent = decimal.point - 1;
  std::string text = (decimal.negative ? "-" : "") + decimal.digits.substr(0, 1) + "." + decimal.digits.substr(1);
  return text.append(letter).append(exponent < 0 ? "-" : "+") + std::to_string(std::abs(exponent));
}

/// The number with as many digits as fit into `width` characters, with a decimal point as both formats demand.
/// INP allows 20 characters; Nastran's large fields 16, where the exponent needs no letter.
std::string fittedNumber(double value, std::size_t width, std::string_view exponentLetter) {
  const Decimal exact = decimalOf(value);
  for (std::size_t digits = exact.digits.size(); digits > 1; --digits) {
    const Decimal decimal = rounded(exact, digits);
    // A plain number this long would only have zeros to show.
    const bool plainFits = std::abs(decimal.point) < static_cast<int>(width);
    if (std::string text = plainFits ? plainText(decimal) : ""; plainFits && text.size() <= width) return text;
    if (std::string text = exponentText(decimal, exponentLetter); text.size() <= width) return text;
  }
  const Decimal decimal = rounded(exact, 1);
  const bool plainFits = std::abs(decimal.point) < static_cast<int>(width) - 3;
  return plainFits ? plainText(decimal) : exponentText(decimal, exponentLetter);
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
  writeField(out, fittedNumber(point.x, kWide, ""), kWide);
  writeField(out, fittedNumber(point.y, kWide, ""), kWide);
  out << "*\n*       ";
  writeField(out, fittedNumber(point.z, kWide, ""), kWide);
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
    for (const double value : {point.x, point.y, point.z}) out << ", " << fittedNumber(value, kNumberWidth, "E");
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
