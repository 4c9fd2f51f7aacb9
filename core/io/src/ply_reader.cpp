// Polygon File Format: ASCII and binary of both byte orders, any types, any elements and properties. Vertices, faces,
// triangle strips and edges are kept, and an integer property of the faces that numbers regions becomes their label.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "ply_header.hpp"
#include "ply_values.hpp"
#include "polygon_soup.hpp"
#include "text_cursor.hpp"

namespace qmcf {
namespace {

/// One element's values: scalars by property, and the values of the one list that is wanted.
struct Row {
  std::vector<double> scalars;
  std::vector<double> list;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, PlyHeader header, Progress& progress)
      : header_(std::move(header)), values_(bytes, header_), progress_(progress) {}

  Result<PolygonSoup> read();

 private:
  bool readElement(const PlyElement& element);
  bool readRow(const PlyElement& element, std::uint64_t row, std::size_t wantedList, Row& values);
  bool readList(const PlyElement& element, const PlyProperty& property, std::uint64_t row, std::vector<double>* list);
  bool addVertex(const Row& row, std::uint64_t index, const std::array<std::size_t, 3>& xyz);
  bool addFace(const Row& row, std::uint64_t index, std::optional<std::size_t> label);
  bool addStrips(const Row& row, std::uint64_t index);
  bool addEdge(const Row& row, const PlyElement& element);
  void labelFace(double value);
  bool checkIndices();
  void nameLabels();
  bool fail(ErrorCode code, const std::string& sentence, std::uint64_t element) {
    error_ = {code, values_.where() + sentence, {static_cast<std::int64_t>(element)}};
    return false;
  }

  PlyHeader header_;
  PlyValueReader values_;
  Progress& progress_;
  PolygonSoup soup_;
  std::map<double, std::int32_t> labelIds_;
  std::map<std::int32_t, std::int32_t> chainIds_;  ///< Numbers of edges in the file, in the order of their first use.
  Error error_;
};

constexpr std::size_t kNoProperty = static_cast<std::size_t>(-1);

std::size_t propertyNamed(const PlyElement& element, std::string_view name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name) return i;
  }
  return kNoProperty;
}

/// The list of a face's vertices. Both names are in wide use.
std::size_t cornersProperty(const PlyElement& element) {
  for (const std::string_view name : {"vertex_indices", "vertex_index"}) {
    const std::size_t property = propertyNamed(element, name);
    if (property != kNoProperty && element.properties[property].isList) return property;
  }
  return kNoProperty;
}

std::optional<std::size_t> labelProperty(const PlyElement& element) {
  for (const std::string_view name : {"face", "label", "region", "segment", "group", "material_index"}) {
    const std::size_t property = propertyNamed(element, name);
    if (property != kNoProperty && !element.properties[property].isList) return property;
  }
  return std::nullopt;
}

std::string elementName(const PlyElement& element, std::uint64_t row) {
  return std::string(element.name == "vertex" || element.name == "face" ? element.name : "element") + " " +
         std::to_string(row) + " (counted from 0)";
}

bool PlyReader::readList(const PlyElement& element, const PlyProperty& property, std::uint64_t row,
                         std::vector<double>* list) {
  double count = 0.0;
  PlyValueState state = values_.next(property.countType, count);
  if (state == PlyValueState::ok && !(count >= 0.0 && count == std::floor(count))) state = PlyValueState::malformed;
  const std::size_t mostValues = values_.remaining() / values_.leastSize(property.type);
  if (state == PlyValueState::ok && count > static_cast<double>(mostValues)) state = PlyValueState::ended;
  for (auto left = state == PlyValueState::ok ? static_cast<std::uint64_t>(count) : 0; left > 0; --left) {
    double value = 0.0;
    state = values_.next(property.type, value);
    if (state != PlyValueState::ok) break;
    if (list != nullptr) list->push_back(value);
  }
  if (state == PlyValueState::ok) return true;
  if (state == PlyValueState::ended) {
    return fail(ErrorCode::truncatedInput,
                "the PLY file ends inside " + elementName(element, row) + "; copy or export it again.", row);
  }
  return fail(ErrorCode::malformedInput, "a list of " + elementName(element, row) + " can't be read; export again.",
              row);
}

bool PlyReader::readRow(const PlyElement& element, std::uint64_t row, std::size_t wantedList, Row& values) {
  values.list.clear();
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    if (property.isList) {
      if (!readList(element, property, row, p == wantedList ? &values.list : nullptr)) return false;
      continue;
    }
    const PlyValueState state = values_.next(property.type, values.scalars[p]);
    if (state == PlyValueState::ended) {
      return fail(ErrorCode::truncatedInput,
                  "the PLY file ends inside " + elementName(element, row) + ", but announces " +
                      std::to_string(element.count) + "; copy or export it again.",
                  row);
    }
    if (state == PlyValueState::malformed) {
      return fail(ErrorCode::malformedInput, "a value of " + elementName(element, row) + " is not a number.", row);
    }
  }
  return true;
}

bool PlyReader::addVertex(const Row& row, std::uint64_t index, const std::array<std::size_t, 3>& xyz) {
  const Vec3 point{row.scalars[xyz[0]], row.scalars[xyz[1]], row.scalars[xyz[2]]};
  if (!isFinite(point)) {
    return fail(ErrorCode::nonFiniteCoordinate,
                "vertex " + std::to_string(index) +
                    " (counted from 0) has a coordinate that is not a finite number; export the model again.",
                index);
  }
  soup_.positions.push_back(point);
  return true;
}

bool isVertexNumber(double value) {
  return value >= 0.0 && value < static_cast<double>(kMaxIndex) && value == std::floor(value);
}

bool PlyReader::addFace(const Row& row, std::uint64_t index, std::optional<std::size_t> label) {
  if (!std::all_of(row.list.begin(), row.list.end(), isVertexNumber)) {
    return fail(ErrorCode::indexOutOfRange,
                "face " + std::to_string(index) +
                    " (counted from 0) names a vertex with an impossible number; "
                    "export the model again.",
                index);
  }
  if (row.list.size() < 3) {
    ++soup_.skippedFaces;
    return true;
  }
  for (const double value : row.list) soup_.corners.push_back(static_cast<std::int32_t>(value));
  soup_.faceEnd.push_back(soup_.corners.size());
  if (label) labelFace(row.scalars[*label]);
  return true;
}

/// Triangles on any three consecutive vertices, every second one turned round; -1 begins a new strip. A vertex that is
/// repeated to go on elsewhere makes no triangle.
bool PlyReader::addStrips(const Row& row, std::uint64_t index) {
  std::array<std::int32_t, 3> last{kNone, kNone, kNone};
  bool turned = false;
  for (const double value : row.list) {
    if (value == -1.0) {
      last = {kNone, kNone, kNone};
      turned = false;
      continue;
    }
    if (!isVertexNumber(value)) {
      return fail(ErrorCode::indexOutOfRange,
                  "triangle strip " + std::to_string(index) +
                      " (counted from 0) names a vertex with an impossible number; export the model again.",
                  index);
    }
    last = {last[1], last[2], static_cast<std::int32_t>(value)};
    if (last[0] == kNone) continue;
    if (last[0] != last[1] && last[1] != last[2] && last[2] != last[0]) {
      if (soup_.faceCount() == kMaxIndex) {
        error_ = tooLargeError("faces");
        return false;
      }
      soup_.corners.insert(soup_.corners.end(), {last[turned ? 1 : 0], last[turned ? 0 : 1], last[2]});
      soup_.faceEnd.push_back(soup_.corners.size());
    }
    turned = !turned;
  }
  return true;
}

void PlyReader::labelFace(double value) {
  const double key = std::isfinite(value) ? value : 0.0;
  const auto entry = labelIds_.try_emplace(key, static_cast<std::int32_t>(labelIds_.size())).first;
  soup_.labels.push_back(entry->second);
}

bool PlyReader::addEdge(const Row& row, const PlyElement& element) {
  const std::size_t a = propertyNamed(element, "vertex1");
  const std::size_t b = propertyNamed(element, "vertex2");
  const std::size_t chain = propertyNamed(element, "edge");
  std::array<std::int32_t, 3> segment{0, 0, 0};
  const std::array<std::size_t, 3> properties{a, b, chain};
  for (std::size_t i = 0; i < 3; ++i) {
    if (properties[i] == kNoProperty) continue;
    const double value = row.scalars[properties[i]];
    if (!(value >= 0.0 && value < static_cast<double>(kMaxIndex))) return true;
    segment[i] = static_cast<std::int32_t>(value);
  }
  segment[2] = chainIds_.try_emplace(segment[2], static_cast<std::int32_t>(chainIds_.size())).first->second;
  soup_.segments.push_back(segment);
  return true;
}

bool PlyReader::readElement(const PlyElement& element) {
  const bool isVertex = element.name == "vertex";
  const bool isFace = element.name == "face";
  const bool isStrip = element.name == "tristrips";
  const bool isEdge = element.name == "edge" && propertyNamed(element, "vertex1") != kNoProperty &&
                      propertyNamed(element, "vertex2") != kNoProperty;
  // Elements without properties have no data, so their count would bound nothing.
  if (element.properties.empty()) return true;
  std::array<std::size_t, 3> xyz{propertyNamed(element, "x"), propertyNamed(element, "y"), propertyNamed(element, "z")};
  const bool hasXyz = std::all_of(xyz.begin(), xyz.end(),
                                  [&](std::size_t p) { return p != kNoProperty && !element.properties[p].isList; });
  if (isVertex && !hasXyz) {
    return fail(ErrorCode::malformedInput, "The PLY file's vertices have no x, y and z; export the model again.", 0);
  }
  const std::size_t corners = isFace || isStrip ? cornersProperty(element) : kNoProperty;
  if ((isFace || isStrip) && corners == kNoProperty) {
    return fail(ErrorCode::malformedInput, "The PLY file's faces have no vertex_indices; export the model again.", 0);
  }
  const std::optional<std::size_t> label = isFace ? labelProperty(element) : std::nullopt;
  Row row;
  row.scalars.resize(element.properties.size());
  constexpr std::uint64_t kRowsPerReport = 8192;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (i % kRowsPerReport == 0 && !progress_.report(Stage::read, values_.fraction())) {
      error_ = cancelledError();
      return false;
    }
    if ((isVertex || isFace) && i == kMaxIndex) {
      error_ = tooLargeError(isVertex ? "vertices" : "faces");
      return false;
    }
    if (!readRow(element, i, corners, row)) return false;
    if (isVertex && !addVertex(row, i, xyz)) return false;
    if (isFace && !addFace(row, i, label)) return false;
    if (isStrip && !addStrips(row, i)) return false;
    if (isEdge && !addEdge(row, element)) return false;
  }
  return true;
}

bool PlyReader::checkIndices() {
  const std::size_t count = soup_.positions.size();
  const auto isOutside = [&](std::int32_t v) { return static_cast<std::size_t>(v) >= count; };
  std::erase_if(soup_.segments, [&](const auto& segment) { return isOutside(segment[0]) || isOutside(segment[1]); });
  const auto bad = std::find_if(soup_.corners.begin(), soup_.corners.end(), isOutside);
  if (bad == soup_.corners.end()) return true;
  const auto corner = static_cast<std::size_t>(bad - soup_.corners.begin());
  const auto face = std::upper_bound(soup_.faceEnd.begin(), soup_.faceEnd.end(), corner) - soup_.faceEnd.begin();
  error_ = {ErrorCode::indexOutOfRange,
            "Face " + std::to_string(face) + " of the PLY file (counted from 0) names vertex " + std::to_string(*bad) +
                ", but there are only " + std::to_string(count) + "; export the model again.",
            {static_cast<std::int64_t>(face)}};
  return false;
}

/// Names come from comments "face_name VALUE NAME", which our own writer leaves.
void PlyReader::nameLabels() {
  std::map<double, std::string_view> names;
  for (const std::string_view comment : header_.comments) {
    constexpr std::string_view kPrefix = "face_name ";
    if (!comment.starts_with(kPrefix)) continue;
    TextCursor cursor(comment.substr(kPrefix.size()));
    double value = 0.0;
    if (cursor.real(value) == NumberState::ok) names.emplace(value, cursor.restOfLine());
  }
  soup_.labelNames.resize(labelIds_.size());
  for (const auto& [value, id] : labelIds_) {
    const auto name = names.find(value);
    const std::string number = std::to_string(static_cast<std::int64_t>(std::fmin(std::fmax(value, -1e15), 1e15)));
    soup_.labelNames[static_cast<std::size_t>(id)] = name != names.end() ? cleanName(name->second) : "face " + number;
  }
}

Result<PolygonSoup> PlyReader::read() {
  for (const PlyElement& element : header_.elements) {
    if (!readElement(element)) return std::move(error_);
  }
  if (!checkIndices()) return std::move(error_);
  if (soup_.labels.size() == soup_.faceCount()) {
    nameLabels();
  } else {
    soup_.labels.clear();  // Only some of several face elements have labels.
  }
  return std::move(soup_);
}

}  // namespace

Result<PolygonSoup> readPly(std::string_view bytes, Progress& progress) {
  Result<PlyHeader> header = readPlyHeader(bytes);
  if (!header.ok()) return header.error();
  return PlyReader(bytes, std::move(header).value(), progress).read();
}

}  // namespace qmcf
