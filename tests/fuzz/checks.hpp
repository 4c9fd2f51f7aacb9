#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "qmcf/io/read.hpp"
#include "qmcf/mesh/triangle_mesh.hpp"

/// What every fuzz target asserts beyond the sanitizers. A property that does not hold ends the program, which is how
/// libFuzzer learns of a finding.
namespace qmcf::fuzz {

/// The input of a fuzz target as the library takes it.
inline std::span<const std::byte> bytesOf(const std::uint8_t* data, std::size_t size) {
  return std::as_bytes(std::span<const std::uint8_t>(data, size));
}

/// Reads the bytes as a model and as a quad mesh. What is read has every index in range, finite coordinates, labels
/// with names, and a size that the bytes can account for; a refusal is a sentence. The model is empty when it is
/// refused.
TriangleMesh checkReading(std::span<const std::byte> bytes);

/// Repairs the mesh, with and without leave to modify, and recovers its B-rep: repaired triangles are triangles, every
/// triangle lies in one face, every face is a surface bounded by its loops, loops run along edges.
void checkTopology(const TriangleMesh& mesh);

}  // namespace qmcf::fuzz
