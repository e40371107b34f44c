// A design of the sections about errors, with its exact picture, and its picture in facets.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "csgcore/scene.hpp"
#include "csgcore/tracer.hpp"
#include "csgcore/view.hpp"
#include "frontend/importer.hpp"
#include "frontend/render.hpp"
#include "picture_errors.hpp"
#include "section.hpp"

namespace measure {

/// The exact picture with one sample a pixel, and with kSupersampling².
struct ExactPictures {
  Picture plain, antialiased;
};

/// The facets that openscad makes of a design with one $fn for all of it.
struct FacetedDesign {
  std::filesystem::path csg;
  csgcore::Scene scene;
  csgcore::Hits hits;
  Picture plain, rendered;
};

/// A design, seen by OpenSCAD's default camera in 640×480.
class ExactDesign {
 public:
  /// Traces the exact picture by the exact ray oracle. Throws WrongAnswer if scadray's CPU tracer,
  /// whose colours the exact pictures have, sees something else.
  ExactDesign(std::string design, const Settings& settings);

  const std::string& design() const { return design_; }
  const Settings& settings() const { return settings_; }
  const std::filesystem::path& csg() const { return csg_; }
  const csgcore::Scene& scene() const { return scene_; }
  const csgcore::View& view() const { return view_; }
  /// --imgsize and --camera, to the last digit, in words that openscad and scadray know.
  const std::vector<std::string>& camera_arguments() const { return camera_arguments_; }

  /// The oracle's hits; only `s` and `primitive` are filled.
  const csgcore::Hits& exact() const { return exact_; }
  /// The hits of scadray's CPU tracer, in double.
  const csgcore::Hits& traced() const { return traced_; }
  /// The diagonal of the model's box.
  double size() const { return size_; }
  const ExactPictures& pictures() const { return pictures_; }
  /// The pictures as OpenSCAD's --render draws them: without color().
  const ExactPictures& rendered_pictures() const { return rendered_; }
  /// The JSON of the check: "judge", "pixels", "undecided", "position_worst".
  const nlohmann::json& check() const { return check_; }

  /// Returns openscad's own export, which is kept. Throws std::runtime_error with openscad's words.
  const FacetedDesign& faceted(uint32_t fragments);

  /// Returns the path of a file of this design in the work folder.
  std::filesystem::path file(const std::string& suffix) const;

 private:
  void hold_against_oracle();

  std::string design_;
  const Settings& settings_;
  std::filesystem::path csg_;
  csgcore::Scene scene_;
  csgcore::View view_;
  std::vector<std::string> camera_arguments_;
  csgcore::Hits exact_, traced_;
  double size_ = 0;
  ExactPictures pictures_, rendered_;
  nlohmann::json check_;
  std::map<uint32_t, FacetedDesign> faceted_;
};

/// Reads a .csg as scadray does.
frontend::ImportedDesign read_csg(const std::filesystem::path& csg,
                                  const frontend::ImportOptions& options);
/// Draws as the command does, but in this program. Throws frontend::Error.
csgcore::Image draw(const csgcore::Scene& scene, const csgcore::View& view,
                    const frontend::RenderSettings& settings);
Picture picture_of(csgcore::Image image);

}  // namespace measure
