#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/base/result.hpp"
#include "qmcf/base/vec.hpp"
#include "qmcf/mesh/ids.hpp"

namespace qmcf {

/// What a file holds, before triangulation: the common result of all readers. Every index is in range.
struct PolygonSoup {
  std::vector<Vec3> positions;
  std::vector<std::int32_t> corners;    ///< Vertices of all faces, one face after the other.
  std::vector<std::size_t> faceEnd;     ///< Per face: end of its corners.
  std::vector<std::int32_t> labels;     ///< Per face: index into labelNames; empty when the file has none.
  std::vector<std::string> labelNames;  ///< Valid UTF-8.
  std::vector<std::array<std::int32_t, 3>> segments;  ///< Vertex, vertex and number of the chain.
  std::int64_t skippedFaces = 0;                      ///< Faces with fewer than three corners.

  [[nodiscard]] std::size_t faceCount() const { return faceEnd.size(); }
  [[nodiscard]] std::span<const std::int32_t> face(std::size_t index) const {
    const std::size_t begin = index == 0 ? 0 : faceEnd[index - 1];
    return {corners.data() + begin, faceEnd[index] - begin};
  }
};

Result<PolygonSoup> readObj(std::string_view text, Progress& progress);
Result<PolygonSoup> readStlAscii(std::string_view text, Progress& progress);
Result<PolygonSoup> readStlBinary(std::string_view bytes, Progress& progress);
Result<PolygonSoup> readPly(std::string_view bytes, Progress& progress);

/// Gives labels an index in the order in which faces first use them. A label is a combination of names, such as object,
/// group and material. The views must stay valid; memory is bounded by the text they view.
class LabelTable {
 public:
  static constexpr std::size_t kParts = 3;

  /// Sets one part of the current label; an empty name unsets it.
  void set(std::size_t part, std::string_view name);
  /// Labels the next face.
  void labelFace();
  /// Moves labels and names to the soup: nothing when no label was ever set. Unlabelled faces are named "default".
  void finish(PolygonSoup& soup);

 private:
  std::string composeName(const std::array<std::int32_t, kParts>& parts) const;

  std::map<std::string_view, std::int32_t> partIds_;
  std::vector<std::string_view> partNames_;
  std::array<std::int32_t, kParts> current_{kNone, kNone, kNone};
  std::map<std::array<std::int32_t, kParts>, std::int32_t> labelIds_;
  std::vector<std::array<std::int32_t, kParts>> labels_;
  std::vector<std::int32_t> faceLabels_;
  std::int32_t currentLabel_ = kNone;
  bool anySet_ = false;
  std::size_t textSize_ = 0;
};

/// An error about a line of text; elements holds the line.
Error lineError(ErrorCode code, std::int64_t line, const std::string& sentence);
/// Counts that need more than 32-bit indices.
Error tooLargeError(const char* what);
inline constexpr std::size_t kMaxIndex = 0x7fffffffU;

}  // namespace qmcf
