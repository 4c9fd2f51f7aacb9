#include "qmcf/base/result.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

#include "qmcf/base/progress.hpp"

namespace qmcf {
namespace {

constexpr int kErrorCount = 0
#define QMCF_ERROR(code, exitStatus, meaning) +1
#include "qmcf/base/errors.def"
#undef QMCF_ERROR
    ;

Result<int> half(int x) {
  if (x % 2 != 0) return Error{ErrorCode::invalidOption, "The number is odd.", {x}};
  return x / 2;
}

TEST(Result, HoldsAValue) {
  const Result<int> result = half(8);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(result.value(), 4);
}

TEST(Result, HoldsAnError) {
  const Result<int> result = half(7);
  ASSERT_FALSE(result.ok());
  EXPECT_FALSE(static_cast<bool>(result));
  EXPECT_EQ(result.error().code, ErrorCode::invalidOption);
  EXPECT_EQ(result.error().message, "The number is odd.");
  EXPECT_EQ(result.error().elements, std::vector<std::int64_t>{7});
}

TEST(Result, GivesUpWhatCanOnlyBeMoved) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(3));
  const std::unique_ptr<int> value = std::move(result).value();
  ASSERT_NE(value, nullptr);
  EXPECT_EQ(*value, 3);
}

TEST(Errors, EveryRowHasItsOwnNameASentenceAndAnExitStatusOfTheCommandLine) {
  std::set<std::string_view> names;
  for (int i = 0; i < kErrorCount; ++i) {
    const auto code = static_cast<ErrorCode>(i);
    EXPECT_TRUE(names.insert(errorName(code)).second) << errorName(code);
    EXPECT_GT(errorMeaning(code).size(), 10U) << errorName(code);
    EXPECT_GE(errorExitStatus(code), 2) << errorName(code);
    EXPECT_LE(errorExitStatus(code), 5) << errorName(code);
  }
}

TEST(Errors, NamesAndExitStatusesAreThePublishedOnes) {
  EXPECT_EQ(errorName(ErrorCode::nonFiniteCoordinate), "nonFiniteCoordinate");
  EXPECT_EQ(errorExitStatus(ErrorCode::invalidOption), 2);
  EXPECT_EQ(errorExitStatus(ErrorCode::truncatedInput), 3);
  EXPECT_EQ(errorExitStatus(ErrorCode::cancelled), 4);
  EXPECT_EQ(errorExitStatus(ErrorCode::internal), 5);
}

TEST(Errors, CancelledErrorSaysSo) {
  EXPECT_EQ(cancelledError().code, ErrorCode::cancelled);
  EXPECT_FALSE(cancelledError().message.empty());
}

TEST(Stages, NamesFollowTheOrderOfARun) {
  EXPECT_EQ(stageName(Stage::read), "read");
  EXPECT_EQ(stageName(Stage::repair), "repair");
  EXPECT_EQ(stageName(Stage::topology), "topology");
  EXPECT_EQ(stageName(Stage::sizing), "sizing");
  EXPECT_EQ(stageName(Stage::background), "background");
  EXPECT_EQ(stageName(Stage::field), "field");
  EXPECT_EQ(stageName(Stage::front), "front");
  EXPECT_EQ(stageName(Stage::cleanup), "cleanup");
  EXPECT_EQ(stageName(Stage::quality), "quality");
  EXPECT_EQ(stageName(Stage::write), "write");
}

TEST(Stages, SilentProgressNeverStopsARun) {
  SilentProgress progress;
  EXPECT_TRUE(progress.report(Stage::front, 0.5));
}

}  // namespace
}  // namespace qmcf
