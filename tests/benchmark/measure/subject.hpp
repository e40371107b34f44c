// A design, and the camera that it is measured from.
#pragma once

#include <memory>
#include <string>

#include "csgcore/scene.hpp"
#include "frontend/camera.hpp"
#include "section.hpp"

namespace measure {

struct Subject {
  std::string name;
  std::shared_ptr<const csgcore::Scene> scene;
  csgcore::Box view_box;
};

/// Reads a design's .csg (designs.hpp).
Subject read_subject(const std::string& design, const Settings& settings);
/// Parses the text of a .csg.
Subject make_subject(const std::string& name, const std::string& csg);

/// Returns the paper's options (§4.1), 640 × 480 by default.
frontend::CameraOptions camera_options(uint32_t width_px = 640, uint32_t height_px = 480);
/// Returns OpenSCAD's default camera, which views all of the box.
frontend::Camera default_camera(const Subject& subject);
csgcore::View default_view(const Subject& subject, const frontend::CameraOptions& options);

/// Compares the CPU's picture at some hundred pixels with the tests' reference; other pictures are
/// then compared with the CPU's. Throws WrongAnswer.
void require_exact(const Subject& subject, const csgcore::View& view);

}  // namespace measure
