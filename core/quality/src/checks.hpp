#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "qmcf/quality/quality.hpp"

namespace qmcf::quality {

/// Collects the outcome of checks in the order in which they are made.
class CheckList {
 public:
  /// The check passes without defects; otherwise it comes to `status`, with the defects' ids.
  /// `what` goes on after the count: "elements name a vertex twice".
  void add(std::string_view name, CheckStatus status, std::vector<std::int64_t> defects, std::string_view what);
  /// A check that has no ids to show: passes when count is 0.
  void addCount(std::string_view name, CheckStatus status, std::int64_t count, std::string sentence);
  void skip(std::string_view name, std::string sentence);

  [[nodiscard]] ValidityReport report() &&;

 private:
  std::vector<ValidityCheck> checks_;
};

}  // namespace qmcf::quality
