#include "files.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace qmcf::cli {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string lastError() { return std::strerror(errno); }

Error readError(const std::string& reason) {
  return {ErrorCode::malformedInput, "The file can't be read: " + reason + ".", {}};
}

Error writeError(const std::string& path, const std::string& reason) {
  return {ErrorCode::unsupportedOutput, path + " can't be written: " + reason + ".", {}};
}

bool isSpecial(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status);
}

/// The file that a rename shall replace: behind a symbolic link, the link's target.
fs::path targetOf(const std::string& path) {
  std::error_code error;
  const fs::path target = fs::canonical(path, error);
  return error ? fs::path(path) : target;
}

std::string temporaryName(const fs::path& target) {
  return target.string() + ".part-" + std::to_string(static_cast<long long>(::getpid()));
}

}  // namespace

Result<std::vector<std::byte>> readFile(const std::string& path) {
  constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 31U;  // A device may never end.
  const Error tooLarge{ErrorCode::tooLarge, "The file has more than 2 GiB, which is more than can be read.", {}};
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return readError("it is a folder");
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) return readError(lastError());
  std::uintmax_t size = fs::is_regular_file(path, ignored) ? fs::file_size(path, ignored) : 0;
  if (ignored || size == static_cast<std::uintmax_t>(-1)) size = 0;
  if (size > kLargestFile) return tooLarge;
  // One byte more than expected shows the end of the file without growing the buffer.
  std::vector<std::byte> content(static_cast<std::size_t>(size) + 1);
  std::size_t used = 0;
  while (true) {
    used += std::fread(content.data() + used, 1, content.size() - used, file.get());
    if (used < content.size()) break;
    if (used > kLargestFile) return tooLarge;
    content.resize(std::max<std::size_t>(2 * content.size(), std::size_t{1} << 16U));
  }
  if (std::ferror(file.get()) != 0) return readError(lastError());
  content.resize(used);
  return content;
}

std::optional<Error> checkWritable(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return writeError(path, "it is a folder");
  if (isSpecial(path)) return std::nullopt;
  const std::string temporary = temporaryName(targetOf(path));
  const bool opened = File(std::fopen(temporary.c_str(), "wb")) != nullptr;
  if (!opened) return writeError(path, lastError());
  std::remove(temporary.c_str());
  return std::nullopt;
}

std::optional<Error> writeFile(const std::string& path, std::string_view content) {
  const bool direct = isSpecial(path);
  const fs::path target = targetOf(path);
  const std::string name = direct ? path : temporaryName(target);
  File file(std::fopen(name.c_str(), "wb"));
  if (!file) return writeError(path, lastError());
  bool written = std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
  written = std::fclose(file.release()) == 0 && written;
  std::string reason = written ? "" : lastError();
  if (written && !direct) {
    std::error_code error;
    fs::rename(name, target, error);
    if (error) reason = error.message();
  }
  if (reason.empty()) return std::nullopt;
  if (!direct) std::remove(name.c_str());
  return writeError(path, reason);
}

}  // namespace qmcf::cli
