#include "openscad_mesh.hpp"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <glm/geometric.hpp>
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

/// The file and the messages that OpenSCAD writes for the design.
struct Export {
  std::string text;  // empty for an empty design
  std::string said;
};

Export export_of(const std::string& scad, const std::string& format) {
  char path[] = "/tmp/scadray-test-XXXXXX";
  const int file = mkstemp(path);
  if (file < 0) throw std::runtime_error("no temporary file");
  const bool written = write(file, scad.data(), scad.size()) == static_cast<ssize_t>(scad.size());
  close(file);
  // Only the messages tell whether OpenSCAD found an empty design.
  const std::string messages = path + std::string(".log");
  Export result;
  if (written) {
    result.text =
        output_of("openscad -o - --export-format=" + format + " - 2>" + messages + " <" + path);
  }
  result.said = output_of("cat " + messages);
  unlink(path);
  unlink(messages.c_str());
  if (result.said.find("top level object is empty") != std::string::npos)
    result.text.clear();
  else if (result.text.empty())
    throw std::runtime_error("openscad: " + result.said);
  return result;
}

}  // namespace

bool openscad_installed() { return !output_of("command -v openscad").empty(); }

csgcore::Mesh openscad_mesh(const std::string& scad) {
  const auto [text, said] = export_of(scad, "off");
  if (text.empty()) return {};
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

csgcore::Mesh openscad_triangles(const std::string& scad) {
  const auto [text, said] = export_of(scad, "stl");
  csgcore::Mesh mesh;
  std::istringstream in(text);
  std::string word;
  while (in >> word) {
    if (word != "vertex") continue;
    csgcore::Vec3& v = mesh.vertices.emplace_back();
    if (!(in >> v.x >> v.y >> v.z)) throw std::runtime_error("openscad: a mesh that ends early");
    const auto corner = static_cast<uint32_t>(mesh.vertices.size() - 1);
    if (corner % 3 == 2) mesh.faces.push_back({corner - 2, corner - 1, corner});
  }
  // If only an edge or a vertex is left, the mesh exists and has no triangles.
  if (!text.empty() && !text.starts_with("solid"))
    throw std::runtime_error("openscad: no ASCII STL");
  return mesh;
}

double volume_of(const csgcore::Mesh& mesh) {
  double six_times = 0;
  for (const auto& face : mesh.faces) {
    for (size_t i = 2; i < face.size(); ++i) {
      six_times += glm::dot(mesh.vertices[face[0]],
                            glm::cross(mesh.vertices[face[i - 1]], mesh.vertices[face[i]]));
    }
  }
  return six_times / 6;
}

}  // namespace test_support
