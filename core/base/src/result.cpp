#include "qmcf/base/result.hpp"

#include <array>

namespace qmcf {
namespace {

struct ErrorRow {
  std::string_view name;
  int exitStatus;
  std::string_view meaning;
};

constexpr auto kErrors = std::to_array<ErrorRow>({
#define QMCF_ERROR(code, exitStatus, meaning) {#code, exitStatus, meaning},
#include "qmcf/base/errors.def"
#undef QMCF_ERROR
});

const ErrorRow& row(ErrorCode code) { return kErrors[static_cast<std::size_t>(code)]; }

}  // namespace

std::string_view errorName(ErrorCode code) { return row(code).name; }
std::string_view errorMeaning(ErrorCode code) { return row(code).meaning; }
int errorExitStatus(ErrorCode code) { return row(code).exitStatus; }

Error cancelledError() { return {ErrorCode::cancelled, "The run was cancelled.", {}}; }

}  // namespace qmcf
