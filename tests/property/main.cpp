// property SEED [--small] [--obj PREFIX]: one case. Exit status 0: nothing wrong; 1: says what is wrong.

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "check.hpp"
#include "limits.hpp"
#include "qmcf/io/write.hpp"

namespace {

using namespace qmcf;
using namespace qmcf::property;

void writeFile(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

QuadMesh trianglesOnly(const TriangleMesh& part) {
  QuadMesh mesh;
  mesh.positions = part.positions;
  for (const auto& t : part.triangles) mesh.elements.push_back({t[0], t[1], t[2], kNone});
  mesh.elementFace.assign(mesh.elements.size(), 0);
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  Limits limits = kLargeCases;
  std::string prefix;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--small") limits = kSmallCases;
    if (argument == "--obj" && i + 1 < argc) prefix = argv[++i];
  }
  if (argc < 2) {
    std::fputs("usage: property SEED [--small] [--obj PREFIX]\n", stderr);
    return 2;
  }
  const Case made = makeCase(std::strtoull(argv[1], nullptr, 10), limits);
  if (!prefix.empty()) {
    WriteOptions options;
    options.faceNames = {"part"};
    writeFile(prefix + "part.obj", writeMesh(trianglesOnly(made.part), OutputFormat::obj, options));
  }
  SilentProgress silent;
  MeshResult result;
  const std::vector<std::string> faults = runCase(made, silent, &result);
  if (!prefix.empty()) {
    WriteOptions options;
    for (const BrepFace& face : result.input.brep.faces) options.faceNames.push_back(face.name);
    writeFile(prefix + "mesh.obj", writeMesh(result.mesh, OutputFormat::obj, options));
  }
  std::string text = describe(made) + ": " + std::to_string(result.quality.quads) + " quads, " +
                     std::to_string(result.quality.triangles) + " triangles\n";
  for (const std::string& fault : faults) text += "  " + fault + "\n";
  for (const FaceReport& face : result.faces) {
    if (!face.reason.empty())
      text += "  (face " + std::to_string(face.face) + " " + face.method + ": " + face.reason + ")\n";
  }
  std::fputs(text.c_str(), stdout);
  return faults.empty() ? 0 : 1;
}
