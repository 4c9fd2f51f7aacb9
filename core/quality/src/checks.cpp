#include "checks.hpp"

#include <algorithm>
#include <utility>

namespace qmcf {

std::string_view checkStatusName(CheckStatus status) {
  switch (status) {
    case CheckStatus::pass:
      return "pass";
    case CheckStatus::warn:
      return "warn";
    case CheckStatus::fail:
      return "fail";
    case CheckStatus::skip:
      return "skip";
  }
  return "";
}

namespace quality {

void CheckList::add(std::string_view name, CheckStatus status, std::vector<std::int64_t> defects,
                    std::string_view what) {
  const auto count = static_cast<std::int64_t>(defects.size());
  addCount(name, status, count, std::to_string(count) + " " + std::string(what) + ".");
  checks_.back().elements = std::move(defects);
}

void CheckList::addCount(std::string_view name, CheckStatus status, std::int64_t count, std::string sentence) {
  ValidityCheck check;
  check.name = name;
  if (count != 0) {
    check.status = status;
    check.count = count;
    check.sentence = std::move(sentence);
  }
  checks_.push_back(std::move(check));
}

void CheckList::skip(std::string_view name, std::string sentence) {
  ValidityCheck check;
  check.name = name;
  check.status = CheckStatus::skip;
  check.sentence = std::move(sentence);
  checks_.push_back(std::move(check));
}

ValidityReport CheckList::report() && {
  ValidityReport result;
  result.checks = std::move(checks_);
  result.valid = std::none_of(result.checks.begin(), result.checks.end(),
                              [](const ValidityCheck& check) { return check.status == CheckStatus::fail; });
  return result;
}

}  // namespace quality
}  // namespace qmcf
