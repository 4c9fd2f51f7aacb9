// How fast models are read: read_speed FILE [RUNS] prints the size, the counts and the CPU seconds of the fastest run.

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string>

#include "qmcf/base/progress.hpp"
#include "qmcf/io/read.hpp"

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  std::ifstream stream(argv[1], std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (text.empty()) return 2;
  const int runs = argc > 2 ? std::atoi(argv[2]) : 5;
  double best = 0.0;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  for (int run = 0; run < runs; ++run) {
    qmcf::SilentProgress silent;
    const std::clock_t begin = std::clock();
    const auto model = qmcf::readModel(std::as_bytes(std::span<const char>(text.data(), text.size())), silent);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    if (!model.ok()) {
      std::fprintf(stderr, "%s\n", model.error().message.c_str());
      return 3;
    }
    vertices = model.value().mesh.positions.size();
    triangles = model.value().mesh.triangles.size();
    if (run == 0 || seconds < best) best = seconds;
  }
  std::printf("{\"bytes\":%zu,\"vertices\":%zu,\"triangles\":%zu,\"seconds\":%.6f}\n", text.size(), vertices, triangles,
              best);
  return 0;
}
