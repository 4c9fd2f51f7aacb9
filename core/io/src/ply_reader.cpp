// Polygon File Format: ASCII and binary of both byte orders, any types, any elements and properties. Vertices, faces
// and edges are kept, and an integer property of the faces that numbers regions becomes their label.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "ply_header.hpp"
#include "polygon_soup.hpp"
#include "qmcf/base/bits.hpp"
#include "text_cursor.hpp"

namespace qmcf {
namespace {

enum class ValueState : std::uint8_t { ok, malformed, ended };

/// Reads the values of the data one by one, whatever their encoding. Infinite and NaN values are passed on.
class ValueReader {
 public:
  ValueReader(std::string_view bytes, const PlyHeader& header)
      : encoding_(header.encoding), data_(bytes.substr(header.size)), cursor_(data_), firstLine_(header.lines) {}

  ValueState next(PlyType type, double& value) {
    return encoding_ == PlyEncoding::ascii ? nextAscii(value) : nextBinary(type, value);
  }
  /// Least bytes that a value takes.
  [[nodiscard]] std::size_t leastSize(PlyType type) const {
    return encoding_ == PlyEncoding::ascii ? 2 : plyTypeSize(type);
  }
  [[nodiscard]] std::size_t remaining() const {
    // One more: the last value of a text needs no separator.
    return encoding_ == PlyEncoding::ascii ? cursor_.remaining() + 1 : data_.size() - offset_;
  }
  [[nodiscard]] double fraction() const {
    return data_.empty() ? 1.0 : 1.0 - static_cast<double>(remaining()) / static_cast<double>(data_.size() + 1);
  }
  /// "Line 7" of a text; nothing in binary data.
  [[nodiscard]] std::string where() const {
    return encoding_ == PlyEncoding::ascii ? "Line " + std::to_string(firstLine_ + cursor_.line()) + ": " : "";
  }

 private:
  ValueState nextAscii(double& value) {
    cursor_.skipSpace();
    switch (cursor_.real(value)) {
      case NumberState::ok:
        return ValueState::ok;
      case NumberState::missing:
        return ValueState::ended;
      case NumberState::nonFinite:
        value = std::numeric_limits<double>::quiet_NaN();
        cursor_.advance(cursor_.token().size());
        return ValueState::ok;
      case NumberState::malformed:
        break;
    }
    return ValueState::malformed;
  }
  ValueState nextBinary(PlyType type, double& value);

  PlyEncoding encoding_;
  std::string_view data_;
  TextCursor cursor_;
  std::size_t offset_ = 0;
  std::int64_t firstLine_;
};

ValueState ValueReader::nextBinary(PlyType type, double& value) {
  const std::size_t size = plyTypeSize(type);
  if (data_.size() - offset_ < size) return ValueState::ended;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t place = encoding_ == PlyEncoding::bigEndian ? i : size - 1 - i;
    bits = bits << 8U | static_cast<unsigned char>(data_[offset_ + place]);
  }
  offset_ += size;
  switch (type) {
    case PlyType::int8:
      value = static_cast<double>(static_cast<std::int8_t>(bits));
      break;
    case PlyType::int16:
      value = static_cast<double>(static_cast<std::int16_t>(bits));
      break;
    case PlyType::int32:
      value = static_cast<double>(static_cast<std::int32_t>(bits));
      break;
    case PlyType::float32:
      value = static_cast<double>(bitCast<float>(static_cast<std::uint32_t>(bits)));
      break;
    case PlyType::float64:
      value = bitCast<double>(bits);
      break;
    case PlyType::uint8:
    case PlyType::uint16:
    case PlyType::uint32:
      value = static_cast<double>(bits);
      break;
  }
  return ValueState::ok;
}

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
  bool addEdge(const Row& row, const PlyElement& element);
  void labelFace(double value);
  bool checkIndices();
  void nameLabels();
  bool fail(ErrorCode code, const std::string& sentence, std::uint64_t element) {
    error_ = {code, values_.where() + sentence, {static_cast<std::int64_t>(element)}};
    return false;
  }

  PlyHeader header_;
  ValueReader values_;
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
  ValueState state = values_.next(property.countType, count);
  if (state == ValueState::ok && !(count >= 0.0 && count == std::floor(count))) state = ValueState::malformed;
  const std::size_t mostValues = values_.remaining() / values_.leastSize(property.type);
  if (state == ValueState::ok && count > static_cast<double>(mostValues)) state = ValueState::ended;
  for (auto left = state == ValueState::ok ? static_cast<std::uint64_t>(count) : 0; left > 0; --left) {
    double value = 0.0;
    state = values_.next(property.type, value);
    if (state != ValueState::ok) break;
    if (list != nullptr) list->push_back(value);
  }
  if (state == ValueState::ok) return true;
  if (state == ValueState::ended) {
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
    const ValueState state = values_.next(property.type, values.scalars[p]);
    if (state == ValueState::ended) {
      return fail(ErrorCode::truncatedInput,
                  "the PLY file ends inside " + elementName(element, row) + ", but announces " +
                      std::to_string(element.count) + "; copy or export it again.",
                  row);
    }
    if (state == ValueState::malformed) {
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

bool PlyReader::addFace(const Row& row, std::uint64_t index, std::optional<std::size_t> label) {
  for (const double value : row.list) {
    if (!(value >= 0.0 && value < static_cast<double>(kMaxIndex) && value == std::floor(value))) {
      return fail(ErrorCode::indexOutOfRange,
                  "face " + std::to_string(index) +
                      " (counted from 0) names a vertex with an impossible number; "
                      "export the model again.",
                  index);
    }
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
  const std::size_t corners = isFace ? cornersProperty(element) : kNoProperty;
  if (isFace && corners == kNoProperty) {
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
