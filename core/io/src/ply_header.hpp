#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "qmcf/base/result.hpp"

namespace qmcf {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyEncoding : std::uint8_t { ascii, littleEndian, bigEndian };

/// Bytes of one value in a binary file.
std::size_t plyTypeSize(PlyType type);

struct PlyProperty {
  std::string_view name;
  bool isList = false;
  PlyType countType = PlyType::uint8;  ///< Of a list.
  PlyType type = PlyType::float32;
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;  ///< As announced: not to be trusted.
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string_view> comments;
  std::size_t size = 0;    ///< Bytes up to the data.
  std::int64_t lines = 0;  ///< Lines up to the data.
};

/// The views point into bytes. Errors: malformedInput, truncatedInput.
Result<PlyHeader> readPlyHeader(std::string_view bytes);

}  // namespace qmcf
