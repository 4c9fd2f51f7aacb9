#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "qmcf/base/progress.hpp"
#include "qmcf/io/read.hpp"

namespace qmcf {

inline std::span<const std::byte> bytesOf(std::string_view text) {
  return std::as_bytes(std::span<const char>(text.data(), text.size()));
}

inline Result<ReadModel> read(std::string_view text) {
  SilentProgress progress;
  return readModel(bytesOf(text), progress);
}

inline Result<QuadMesh> readQuads(std::string_view text) {
  SilentProgress progress;
  return readQuadMesh(bytesOf(text), progress);
}

/// The model, or a failed test that shows the error.
inline ReadModel readOk(std::string_view text) {
  Result<ReadModel> model = read(text);
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().message);
  return model.ok() ? std::move(model).value() : ReadModel{};
}

inline void expectError(std::string_view text, ErrorCode code, std::string_view part) {
  const Result<ReadModel> model = read(text);
  ASSERT_FALSE(model.ok()) << text;
  EXPECT_EQ(errorName(model.error().code), errorName(code)) << model.error().message;
  EXPECT_NE(model.error().message.find(part), std::string::npos) << model.error().message;
}

template <class Bits>
void append(std::string& out, Bits bits, bool bigEndian = false) {
  for (std::size_t i = 0; i < sizeof(Bits); ++i) {
    const std::size_t shift = 8U * (bigEndian ? sizeof(Bits) - 1 - i : i);
    out += static_cast<char>(static_cast<std::uint64_t>(bits) >> shift & 0xFFU);
  }
}

inline void appendFloat(std::string& out, float value, bool bigEndian = false) {
  append(out, std::bit_cast<std::uint32_t>(value), bigEndian);
}
inline void appendDouble(std::string& out, double value, bool bigEndian = false) {
  append(out, std::bit_cast<std::uint64_t>(value), bigEndian);
}

/// A binary STL of triangles (i, i, 0) (i + 1, i, 0) (i, i + 1, 0).
inline std::string binaryStl(std::uint32_t triangles, std::string header = "made by a test") {
  header.resize(80, ' ');
  append(header, triangles);
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const auto i = static_cast<float>(t);
    for (const float value : {0.0F, 0.0F, 1.0F, i, i, 0.0F, i + 1.0F, i, 0.0F, i, i + 1.0F, 0.0F}) {
      appendFloat(header, value);
    }
    append(header, std::uint16_t{0});
  }
  return header;
}

inline Vec3 areaVector(const TriangleMesh& mesh, std::size_t t) {
  const auto p = [&](std::size_t c) { return mesh.positions[static_cast<std::size_t>(mesh.triangles[t][c])]; };
  return cross(p(1) - p(0), p(2) - p(0)) * 0.5;
}

}  // namespace qmcf
