// Wavefront OBJ: vertices, also with x and y alone; polygons (v, v/vt, v//vn, v/vt/vn, negative indices), polylines,
// groups, objects, materials. Everything else is passed over.

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "polygon_soup.hpp"
#include "text_cursor.hpp"

namespace qmcf {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view text, Progress& progress) : cursor_(text), size_(text.size()), progress_(progress) {}

  Result<PolygonSoup> read();

 private:
  enum LabelPart : std::size_t { kObject, kGroup, kMaterial };

  /// A vertex that was named before the file had so many: an error unless the vertices follow.
  struct ForwardReference {
    std::int64_t index;
    std::int64_t line;
  };

  bool readStatement();
  bool readVertex();
  bool readCorners(std::string_view kind);
  bool readFace();
  bool readPolyline();
  bool resolve(std::int64_t written, std::string_view kind, std::int32_t& index);
  bool fail(ErrorCode code, const std::string& sentence) {
    error_ = lineError(code, cursor_.line(), sentence);
    return false;
  }
  bool checkForwardReferences();

  TextCursor cursor_;
  std::size_t size_;
  Progress& progress_;
  PolygonSoup soup_;
  LabelTable labels_;
  std::vector<std::int32_t> corners_;
  std::vector<ForwardReference> forward_;  ///< Ever larger indices: the first out of range names the first bad line.
  std::string_view group_;
  std::map<std::string_view, std::int32_t> chains_;  ///< Groups that hold line elements.
  Error error_;
};

bool ObjReader::readVertex() {
  if (soup_.positions.size() == kMaxIndex) {
    error_ = tooLargeError("vertices");
    return false;
  }
  std::array<double, 3> xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const NumberState state = cursor_.real(xyz[axis]);
    if (state == NumberState::ok) continue;
    // Plane meshes are also written with x and y alone.
    if (axis == 2 && (state == NumberState::missing || cursor_.peek() == '#')) break;
    if (state == NumberState::missing) {
      return fail(ErrorCode::malformedInput, "a vertex needs three coordinates; complete the line or export again.");
    }
    const std::string token = quoted(cursor_.token());
    if (state == NumberState::nonFinite) {
      return fail(ErrorCode::nonFiniteCoordinate,
                  "the coordinate " + token + " is not a finite number; correct it or export the model again.");
    }
    return fail(ErrorCode::malformedInput,
                "the coordinate " + token + " is not a number (decimals are written with a point).");
  }
  soup_.positions.push_back({xyz[0], xyz[1], xyz[2]});
  return true;
}

bool ObjReader::resolve(std::int64_t written, std::string_view kind, std::int32_t& index) {
  const auto count = static_cast<std::int64_t>(soup_.positions.size());
  const std::int64_t resolved = written > 0 ? written - 1 : count + written;
  if (written == 0 || resolved < 0 || resolved >= static_cast<std::int64_t>(kMaxIndex)) {
    const std::string reason = written == 0 ? ", but OBJ counts vertices from 1."
                                            : ", but there are only " + std::to_string(count) + " vertices up to here.";
    return fail(ErrorCode::indexOutOfRange,
                "the " + std::string(kind) + " names vertex " + std::to_string(written) + reason);
  }
  if (resolved >= count && (forward_.empty() || resolved > forward_.back().index)) {
    forward_.push_back({resolved, cursor_.line()});
  }
  index = static_cast<std::int32_t>(resolved);
  return true;
}

bool ObjReader::readCorners(std::string_view kind) {
  corners_.clear();
  while (true) {
    std::int64_t written = 0;
    const NumberState state = cursor_.integer(written);
    if (state == NumberState::missing) return true;
    const char after = cursor_.peek();
    const bool slash = after == '/';
    const bool whole = slash || cursor_.atLineEnd() || TextCursor::isBlank(after) || after == '\\';
    if (state != NumberState::ok || !whole) {
      return fail(ErrorCode::malformedInput, quoted(cursor_.token()) + " in this " + std::string(kind) +
                                                 " is not a vertex number; correct it or export the model again.");
    }
    // Texture coordinate and normal: not used here.
    if (slash) {
      while (!cursor_.atLineEnd() && !TextCursor::isBlank(cursor_.peek()) && cursor_.peek() != '\\') cursor_.advance(1);
    }
    std::int32_t index = 0;
    if (!resolve(written, kind, index)) return false;
    corners_.push_back(index);
  }
}

bool ObjReader::readFace() {
  if (!readCorners("face")) return false;
  if (corners_.size() < 3) {
    ++soup_.skippedFaces;
    return true;
  }
  if (soup_.faceCount() == kMaxIndex) {
    error_ = tooLargeError("faces");
    return false;
  }
  soup_.corners.insert(soup_.corners.end(), corners_.begin(), corners_.end());
  soup_.faceEnd.push_back(soup_.corners.size());
  labels_.labelFace();
  return true;
}

bool ObjReader::readPolyline() {
  if (!readCorners("line element")) return false;
  const std::int32_t chain = chains_.try_emplace(group_, static_cast<std::int32_t>(chains_.size())).first->second;
  for (std::size_t i = 1; i < corners_.size(); ++i) soup_.segments.push_back({corners_[i - 1], corners_[i], chain});
  return true;
}

bool ObjReader::readStatement() {
  const char first = cursor_.peek();
  const char second = cursor_.peek(1);
  const bool oneLetter = TextCursor::isBlank(second) || second == '\n' || second == '\r' || second == '\\';
  if (oneLetter && (first == 'v' || first == 'f' || first == 'l')) {
    cursor_.advance(1);
    return first == 'v' ? readVertex() : first == 'f' ? readFace() : readPolyline();
  }
  if (first == 'v' || first == '#') return true;
  const std::string_view keyword = cursor_.token();
  if (keyword == "o" || keyword == "g" || keyword == "usemtl") {
    cursor_.advance(keyword.size());
    const std::string_view name = cursor_.restOfLine();
    if (keyword == "g") group_ = name;
    labels_.set(keyword == "o" ? kObject : keyword == "g" ? kGroup : kMaterial, name);
  }
  return true;
}

bool ObjReader::checkForwardReferences() {
  const auto count = static_cast<std::int64_t>(soup_.positions.size());
  for (const ForwardReference& reference : forward_) {
    if (reference.index < count) continue;
    error_ = lineError(ErrorCode::indexOutOfRange, reference.line,
                       "vertex " + std::to_string(reference.index + 1) + " is named, but the file has only " +
                           std::to_string(count) + " vertices; the file is incomplete or damaged.");
    return false;
  }
  return true;
}

Result<PolygonSoup> ObjReader::read() {
  constexpr std::int64_t kLinesPerReport = 8192;
  std::int64_t nextReport = 0;
  while (!cursor_.atEnd()) {
    if (cursor_.line() >= nextReport) {
      nextReport = cursor_.line() + kLinesPerReport;
      const double fraction = static_cast<double>(cursor_.offset()) / static_cast<double>(size_);
      if (!progress_.report(Stage::read, fraction)) return cancelledError();
    }
    cursor_.skipBlanks();
    // Elsewhere a backslash at the end of a line is the end of a path or a name.
    const char first = cursor_.peek();
    const bool continued = first == 'v' || first == 'f' || first == 'l';
    if (!readStatement()) return std::move(error_);
    cursor_.nextLine(continued);
  }
  if (!checkForwardReferences()) return std::move(error_);
  labels_.finish(soup_);
  return std::move(soup_);
}

}  // namespace

Result<PolygonSoup> readObj(std::string_view text, Progress& progress) { return ObjReader(text, progress).read(); }

}  // namespace qmcf
