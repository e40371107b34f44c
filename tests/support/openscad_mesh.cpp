#include "openscad_mesh.hpp"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <sstream>
#include <stdexcept>

namespace test_support {
namespace {

std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run: " + command);
  std::string text;
  char buffer[4096];
  for (size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
  pclose(pipe);
  return text;
}

}  // namespace

bool openscad_installed() { return !output_of("command -v openscad").empty(); }

csgcore::Mesh openscad_mesh(const std::string& scad) {
  char path[] = "/tmp/scadray-test-XXXXXX";
  const int file = mkstemp(path);
  if (file < 0) throw std::runtime_error("no temporary file");
  const bool written = write(file, scad.data(), scad.size()) == static_cast<ssize_t>(scad.size());
  close(file);
  // Whether an empty design is what it found, only its messages tell.
  const std::string messages = path + std::string(".log");
  const std::string text =
      written ? output_of("openscad -o - --export-format=off - 2>" + messages + " <" + path) : "";
  const std::string said = output_of("cat " + messages);
  unlink(path);
  unlink(messages.c_str());
  if (said.find("top level object is empty") != std::string::npos) return {};

  std::istringstream in(text);
  std::string magic;
  size_t vertices = 0, faces = 0, edges = 0;
  in >> magic >> vertices >> faces >> edges;
  if (magic != "OFF" || !in) throw std::runtime_error("openscad: " + said);
  csgcore::Mesh mesh;
  mesh.vertices.resize(vertices);
  mesh.faces.resize(faces);
  for (csgcore::Vec3& v : mesh.vertices) in >> v.x >> v.y >> v.z;
  for (std::vector<uint32_t>& face : mesh.faces) {
    size_t corners = 0;
    in >> corners;
    face.resize(in ? corners : 0);
    for (uint32_t& vertex : face) in >> vertex;
    in.ignore(4096, '\n');  // a colour may follow
  }
  if (!in) throw std::runtime_error("openscad: a mesh that ends early");
  return mesh;
}

}  // namespace test_support
