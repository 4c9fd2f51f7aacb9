// Stereolithography files, ASCII and binary. Every triangle keeps three vertices of its own: welding is repair's task.

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "polygon_soup.hpp"
#include "qmcf/base/bits.hpp"
#include "text_cursor.hpp"

namespace qmcf {
namespace {

constexpr std::size_t kHeaderSize = 84;
constexpr std::size_t kRecordSize = 50;
constexpr std::size_t kMaxTriangles = kMaxIndex / 3;

class AsciiStlReader {
 public:
  AsciiStlReader(std::string_view text, Progress& progress) : cursor_(text), size_(text.size()), progress_(progress) {}

  Result<PolygonSoup> read();

 private:
  bool readSolids();
  bool readFacet();
  bool readVertex();
  /// Consumes the next token, which must be the keyword.
  bool expect(std::string_view keyword);
  bool nextIs(std::string_view keyword) {
    cursor_.skipSpace();
    return equalsIgnoringCase(cursor_.token(), keyword);
  }
  void skipToken() { cursor_.advance(cursor_.token().size()); }
  bool fail(ErrorCode code, const std::string& sentence) {
    error_ = lineError(code, cursor_.line(), sentence);
    return false;
  }
  bool failTruncated() {
    return fail(ErrorCode::truncatedInput, "the file ends inside triangle " + std::to_string(soup_.faceCount() + 1) +
                                               "; it was probably cut off when it was copied or saved.");
  }

  TextCursor cursor_;
  std::size_t size_;
  Progress& progress_;
  PolygonSoup soup_;
  std::string_view solidName_;
  bool solidHasLabel_ = false;
  Error error_;
};

bool AsciiStlReader::expect(std::string_view keyword) {
  cursor_.skipSpace();
  if (cursor_.atEnd()) return failTruncated();
  const std::string_view token = cursor_.token();
  if (!equalsIgnoringCase(token, keyword)) {
    return fail(ErrorCode::malformedInput,
                "expected \"" + std::string(keyword) + "\" but found " + quoted(token) + "; export the model again.");
  }
  skipToken();
  return true;
}

bool AsciiStlReader::readVertex() {
  if (!expect("vertex")) return false;
  std::array<double, 3> xyz{};
  for (double& coordinate : xyz) {
    cursor_.skipSpace();
    const NumberState state = cursor_.real(coordinate);
    if (state == NumberState::ok) continue;
    if (state == NumberState::missing) return failTruncated();
    const std::string coordinateText = "the coordinate " + quoted(cursor_.token());
    const std::string where = " of triangle " + std::to_string(soup_.faceCount() + 1);
    if (state == NumberState::nonFinite) {
      return fail(ErrorCode::nonFiniteCoordinate,
                  coordinateText + where + " is not a finite number; correct it or export the model again.");
    }
    return fail(ErrorCode::malformedInput,
                coordinateText + where + " is not a number (decimals are written with a point).");
  }
  soup_.positions.push_back({xyz[0], xyz[1], xyz[2]});
  return true;
}

bool AsciiStlReader::readFacet() {
  // The normal follows from the vertices and is often missing or NaN.
  skipToken();
  while (!nextIs("outer")) {
    if (cursor_.atEnd()) return failTruncated();
    if (nextIs("facet") || nextIs("vertex") || nextIs("endsolid")) return expect("outer");
    skipToken();
  }
  if (!expect("outer") || !expect("loop")) return false;
  for (int corner = 0; corner < 3; ++corner) {
    if (!readVertex()) return false;
  }
  if (!expect("endloop") || !expect("endfacet")) return false;
  const auto first = static_cast<std::int32_t>(soup_.positions.size()) - 3;
  soup_.corners.insert(soup_.corners.end(), {first, first + 1, first + 2});
  soup_.faceEnd.push_back(soup_.corners.size());
  if (!solidHasLabel_) {
    const std::string number = "solid " + std::to_string(soup_.labelNames.size() + 1);
    soup_.labelNames.push_back(solidName_.empty() ? number : cleanName(solidName_));
    solidHasLabel_ = true;
  }
  soup_.labels.push_back(static_cast<std::int32_t>(soup_.labelNames.size()) - 1);
  return true;
}

bool AsciiStlReader::readSolids() {
  constexpr std::size_t kTrianglesPerReport = 4096;
  bool inSolid = false;
  while (true) {
    cursor_.skipSpace();
    if (cursor_.atEnd()) break;
    if (nextIs("facet")) {
      if (soup_.faceCount() == kMaxTriangles) {
        error_ = tooLargeError("vertices");
        return false;
      }
      if (soup_.faceCount() % kTrianglesPerReport == 0 &&
          !progress_.report(Stage::read, static_cast<double>(cursor_.offset()) / static_cast<double>(size_))) {
        error_ = cancelledError();
        return false;
      }
      if (!readFacet()) return false;
    } else if (nextIs("solid")) {
      skipToken();
      solidName_ = cursor_.restOfLine();
      solidHasLabel_ = false;
      inSolid = true;
    } else if (nextIs("endsolid") || nextIs("end")) {
      cursor_.nextLine(false);
      inSolid = false;
    } else {
      return fail(ErrorCode::malformedInput, "expected \"facet\" or \"endsolid\" but found " + quoted(cursor_.token()) +
                                                 "; export the model again.");
    }
  }
  if (inSolid && !soup_.faceEnd.empty()) {
    return fail(ErrorCode::truncatedInput,
                "the file ends without \"endsolid\", so triangles are probably missing; copy or export it again.");
  }
  return true;
}

Result<PolygonSoup> AsciiStlReader::read() {
  if (!readSolids()) return std::move(error_);
  if (soup_.labelNames.size() == 1 && solidName_.empty()) {
    soup_.labels.clear();
    soup_.labelNames.clear();
  }
  return std::move(soup_);
}

std::uint32_t littleEndian32(const char* bytes) {
  std::array<unsigned char, 4> b{};
  std::memcpy(b.data(), bytes, b.size());
  return static_cast<std::uint32_t>(b[0]) | static_cast<std::uint32_t>(b[1]) << 8U |
         static_cast<std::uint32_t>(b[2]) << 16U | static_cast<std::uint32_t>(b[3]) << 24U;
}

double coordinateAt(const char* bytes) { return static_cast<double>(bitCast<float>(littleEndian32(bytes))); }

}  // namespace

Result<PolygonSoup> readStlAscii(std::string_view text, Progress& progress) {
  return AsciiStlReader(text, progress).read();
}

Result<PolygonSoup> readStlBinary(std::string_view bytes, Progress& progress) {
  constexpr std::size_t kTrianglesPerReport = 1U << 16U;
  const std::size_t count = littleEndian32(bytes.data() + kHeaderSize - 4);
  const std::size_t available = (bytes.size() - kHeaderSize) / kRecordSize;
  if (count > available) {
    return Error{ErrorCode::truncatedInput,
                 "The STL file announces " + std::to_string(count) + " triangles but ends after " +
                     std::to_string(available) + "; copy or export it again.",
                 {}};
  }
  if (count > kMaxTriangles) return tooLargeError("vertices");
  PolygonSoup soup;
  soup.positions.resize(3 * count);
  soup.corners.resize(3 * count);
  soup.faceEnd.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    if (t % kTrianglesPerReport == 0 &&
        !progress.report(Stage::read, static_cast<double>(t) / static_cast<double>(count))) {
      return cancelledError();
    }
    const char* const vertices = bytes.data() + kHeaderSize + t * kRecordSize + 12;
    for (std::size_t v = 0; v < 3; ++v) {
      const char* const xyz = vertices + 12 * v;
      const Vec3 point{coordinateAt(xyz), coordinateAt(xyz + 4), coordinateAt(xyz + 8)};
      if (!isFinite(point)) {
        return Error{ErrorCode::nonFiniteCoordinate,
                     "Triangle " + std::to_string(t) +
                         " of the STL file (counted from 0) has a coordinate that is not "
                         "a finite number; the file is damaged, export it again.",
                     {static_cast<std::int64_t>(t)}};
      }
      soup.positions[3 * t + v] = point;
      soup.corners[3 * t + v] = static_cast<std::int32_t>(3 * t + v);
    }
    soup.faceEnd[t] = 3 * t + 3;
  }
  return soup;
}

}  // namespace qmcf
