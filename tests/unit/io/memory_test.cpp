// What a reader allocates is bounded by the size of the file, whatever counts and indices the file announces.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#include "io/io_support.hpp"

namespace {

std::atomic<std::size_t> liveBytes{0};
std::atomic<std::size_t> peakBytes{0};

constexpr std::size_t kHeader = alignof(std::max_align_t);

void* countedAlloc(std::size_t size) {
  auto* const block = static_cast<char*>(std::malloc(size + kHeader));
  if (block == nullptr) throw std::bad_alloc();
  *reinterpret_cast<std::size_t*>(block) = size;
  const std::size_t live = liveBytes += size;
  std::size_t peak = peakBytes;
  while (live > peak && !peakBytes.compare_exchange_weak(peak, live)) {
  }
  return block + kHeader;
}

void countedFree(void* pointer) noexcept {
  if (pointer == nullptr) return;
  auto* const block = static_cast<char*>(pointer) - kHeader;
  liveBytes -= *reinterpret_cast<std::size_t*>(block);
  std::free(block);
}

}  // namespace

// Every allocation of this program goes through these, the arrays' and the sized forms by their defaults.
void* operator new(std::size_t size) { return countedAlloc(size); }
void operator delete(void* pointer) noexcept { countedFree(pointer); }
void operator delete(void* pointer, std::size_t /*size*/) noexcept { countedFree(pointer); }

namespace qmcf {
namespace {

/// Most bytes in use at one time while the text is read.
std::size_t peakOfReading(std::string_view text) {
  const std::size_t before = liveBytes;
  peakBytes = before;
  { const Result<ReadModel> model = read(text); }
  return peakBytes - before;
}

/// A vertex takes 24 bytes, a triangle 12 and what stands for it before polygons are cut 20 more; vectors double.
std::size_t bound(std::string_view text) { return 64 * text.size() + 16384; }

TEST(ReaderMemory, IsMeasured) {
  const std::string stl = binaryStl(1000);
  EXPECT_GT(peakOfReading(stl), 1000U * (3 * 24 + 12));
}

TEST(ReaderMemory, CountsThatTheFileDoesNotHoldCostNothing) {
  std::string stl = binaryStl(2);
  for (std::size_t i = 80; i < 84; ++i) stl[i] = '\xff';
  EXPECT_LT(peakOfReading(stl), bound(stl));

  const std::string types[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  for (const std::string& type : types) {
    const std::string vertices = "ply\nformat " + type +
                                 " 1.0\nelement vertex 99999999999\nproperty float x\nproperty float y\n"
                                 "property float z\nelement face 99999999999\nproperty list uint uint vertex_indices\n"
                                 "end_header\n1 2 3 4 5 6 7 8\n";
    EXPECT_LT(peakOfReading(vertices), bound(vertices)) << type;
    const std::string corners = "ply\nformat " + type +
                                " 1.0\nelement face 99999999999\nproperty list uint uint vertex_indices\nend_header\n" +
                                (type == "ascii" ? "4294967295 1 2 3\n" : std::string(24, '\xfe'));
    EXPECT_LT(peakOfReading(corners), bound(corners)) << type;
    const std::string nothing = "ply\nformat " + type + " 1.0\nelement vertex 99999999999\nend_header\n";
    EXPECT_LT(peakOfReading(nothing), bound(nothing)) << type;
  }

  const std::string obj = "v 0 0 0\nf 1 2147483000 2147483646\nf -1 99999999999999999999 3\n";
  EXPECT_LT(peakOfReading(obj), bound(obj));
}

TEST(ReaderMemory, GrowsWithTheFileAndNoFaster) {
  std::string obj = "v 0 0\nv 1 0\nv 0 1\n";
  std::string strips =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
      "element tristrips 1\nproperty list uint uchar vertex_indices\nend_header\n";
  strips += std::string("\0\0\0\1\0\0\0\1\0", 9);
  constexpr std::uint32_t kLength = 30000;
  append(strips, kLength);
  for (std::uint32_t i = 0; i < kLength; ++i) {
    obj += "f 1 2 3\n";
    strips += static_cast<char>(i % 3);
  }
  const std::string stl = binaryStl(5000);
  for (const std::string& text : {obj, strips, stl}) {
    EXPECT_TRUE(read(text).ok());
    EXPECT_LT(peakOfReading(text), bound(text));
  }
  const std::string polygon = "v 0 0\nv 1 0\nv 0 1\nf" + [] {
    std::string corners;
    for (int i = 0; i < 30000; ++i) corners += i % 3 == 0 ? " 1" : i % 3 == 1 ? " 2" : " 3";
    return corners;
  }();
  EXPECT_LT(peakOfReading(polygon), bound(polygon));
}

}  // namespace
}  // namespace qmcf
