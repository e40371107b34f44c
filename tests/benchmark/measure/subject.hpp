// A design and the camera that it is measured from.
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

/// Of a design's .csg (designs.hpp).
Subject read_subject(const std::string& design, const Settings& settings);
/// Of the text of a .csg.
Subject make_subject(const std::string& name, const std::string& csg);

/// The paper's (§4.1), 640 × 480, by default.
frontend::CameraOptions camera_options(uint32_t width_px = 640, uint32_t height_px = 480);
/// OpenSCAD's default camera, which views all of the box.
frontend::Camera default_camera(const Subject& subject);
csgcore::View default_view(const Subject& subject, const frontend::CameraOptions& options);

/// Holds the CPU's picture at some hundred pixels against the tests' reference: what every other
/// picture is then compared with. Throws WrongAnswer.
void require_exact(const Subject& subject, const csgcore::View& view);

}  // namespace measure
