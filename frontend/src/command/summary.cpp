#include "command/summary.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

namespace frontend {
namespace {

constexpr double kFov_deg = 22.5;  // OpenSCAD's vertical field of view

template <typename... Numbers>
std::string formatted(const char* format, Numbers... numbers) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, numbers...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, numbers...);
  return text;
}

/// Returns the components, as many as the figures have dimensions.
std::vector<double> components(const csgcore::Vec3& v, const ModelFigures& figures) {
  return figures.is_plane ? std::vector{v.x, v.y} : std::vector{v.x, v.y, v.z};
}

std::string listed_numbers(const std::vector<double>& numbers) {
  std::string list;
  for (const double number : numbers)
    list += (list.empty() ? "" : ", ") + formatted("%.2f", number);
  return list;
}

std::string listed_numbers(const csgcore::Vec3& v) {
  return listed_numbers(std::vector{v.x, v.y, v.z});
}

/// A duration in the parts that OpenSCAD tells it in.
struct Duration {
  explicit Duration(double time_ms) : total_ms(static_cast<int64_t>(std::llround(time_ms))) {}
  int64_t total_ms;
  long hours() const { return total_ms / 3'600'000; }
  long minutes() const { return total_ms / 60'000 % 60; }
  long seconds() const { return total_ms / 1000 % 60; }
  long milliseconds() const { return total_ms % 1000; }
  std::string text() const {
    return formatted("%ld:%02ld:%02ld.%03ld", hours(), minutes(), seconds(), milliseconds());
  }
};

std::string geometry_text(const ModelFigures& figures) {
  if (figures.is_plane) {
    return "Top level object is a 2D object:\n" +
           formatted("   Contours: %8zu\n", figures.outlines);
  }
  std::string text = "   Top level object is a 3D object (manifold):\n";
  if (!figures.is_closed) {
    text += "   Status:     NotManifold\n";
  } else {
    // Euler's formula, of a mesh of triangles: each has three halves of edges.
    const auto vertices = static_cast<int64_t>(figures.vertices);
    const auto triangles = static_cast<int64_t>(figures.triangles);
    const int64_t genus = 1 - (vertices - triangles * 3 / 2 + triangles) / 2;
    text +=
        "   Status:     NoError\n" + formatted("   Genus:      %ld\n", static_cast<long>(genus));
  }
  return text +
         formatted("   Vertices: %8zu\n   Facets:   %10zu\n", figures.vertices, figures.triangles);
}

nlohmann::json geometry_json(const SummaryParts& parts, const ModelFigures& figures) {
  nlohmann::json json;
  if (parts.geometry) {
    json["dimensions"] = figures.is_plane ? 2 : 3;
    if (figures.is_plane) {
      json["contours"] = figures.outlines;
      json["convex"] = figures.is_convex;
    } else {
      json["simple"] = figures.is_closed;
      json["vertices"] = figures.vertices;
      json["facets"] = figures.triangles;
    }
  }
  if (parts.bounding_box) {
    const csgcore::Box& box = figures.box;
    json["bounding_box"] = {{"min", components(box.min, figures)},
                            {"max", components(box.max, figures)},
                            {"size", components(box.max - box.min, figures)}};
  }
  if (parts.area) json["area"] = figures.area;
  return json;
}

}  // namespace

std::string summary_text(const SummaryParts& parts, const Summary& summary) {
  std::string text;
  if (parts.cache) {  // there is none
    text +=
        "Geometries in cache: 0\nGeometry cache size in bytes: 0\n"
        "CGAL Polyhedrons in cache: 0\nCGAL cache size in bytes: 0\n";
  }
  if (parts.time) text += "Total rendering time: " + Duration(summary.time_ms).text() + "\n";
  if (const std::optional<ModelFigures>& figures = summary.figures) {
    const csgcore::Box& box = figures->box;
    if (parts.geometry) text += geometry_text(*figures);
    if (parts.bounding_box) {
      text += "Bounding box:\n   Min:  " + listed_numbers(components(box.min, *figures)) +
              "\n   Max:  " + listed_numbers(components(box.max, *figures)) +
              "\n   Size: " + listed_numbers(components(box.max - box.min, *figures)) + "\n";
    }
    if (parts.area) text += "Measurements:\n" + formatted("   Area: %.2f\n", figures->area);
  }
  if (parts.camera) {
    const Camera& camera = summary.camera;
    text += "Camera:\n   Translation: " + listed_numbers(camera.target) +
            "\n   Rotation:    " + listed_numbers(camera.rotation_deg) +
            formatted("\n   Distance:    %.2f\n   FOV:         %.2f\n", camera.distance, kFov_deg);
  }
  return text;
}

std::string summary_json(const SummaryParts& parts, const Summary& summary) {
  nlohmann::json json;
  if (parts.cache) {
    const nlohmann::json none = {{"bytes", 0}, {"entries", 0}, {"max_size", 0}};
    json["cache"] = {{"cgal_cache", none}, {"geometry_cache", none}};
  }
  if (parts.time) {
    const Duration time(summary.time_ms);
    json["time"] = {{"hours", time.hours()},     {"minutes", time.minutes()},
                    {"seconds", time.seconds()}, {"milliseconds", time.milliseconds()},
                    {"time", time.text()},       {"total", time.total_ms}};
  }
  if (summary.figures) json["geometry"] = geometry_json(parts, *summary.figures);
  if (parts.camera) {
    const auto numbers = [](const csgcore::Vec3& v) { return std::vector{v.x, v.y, v.z}; };
    const Camera& camera = summary.camera;
    json["camera"] = {{"translation", numbers(camera.target)},
                      {"rotation", numbers(camera.rotation_deg)},
                      {"distance", camera.distance},
                      {"fov", kFov_deg}};
  }
  return json.dump() + '\n';
}

}  // namespace frontend
