// The seeds of the fuzz targets, and every input that a fuzz target or a user ever found to break something
// (tests/data), go through the targets' checks in every build.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "checks.hpp"
#include "soup.hpp"

namespace qmcf::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> filesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() != ".md") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Checks that fail end the program, after this has said which file it was.
void replay(const fs::path& file) {
  SCOPED_TRACE(file.string());
  std::ifstream stream(file, std::ios::binary);
  ASSERT_TRUE(stream.good());
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  std::fprintf(stderr, "%s\n", file.filename().c_str());
  const auto bytes = std::as_bytes(std::span<const char>(text.data(), text.size()));
  const bool isSoup = file.parent_path().filename() == "soup";
  checkTopology(isSoup ? soupFromBytes(bytes) : checkReading(bytes));
}

TEST(Replay, SeedsOfTheFuzzTargets) {
  const std::vector<fs::path> files = filesBelow(fs::path(QMCF_TESTS) / "fuzz" / "seeds");
  EXPECT_GE(files.size(), 12U);
  for (const fs::path& file : files) replay(file);
}

TEST(Replay, InputsThatOnceBrokeSomething) {
  for (const fs::path& file : filesBelow(fs::path(QMCF_TESTS) / "data")) replay(file);
}

}  // namespace
}  // namespace qmcf::fuzz
