// Parts of the section "paper".
#pragma once

#include <string>
#include <vector>

#include "bench/measurement.hpp"
#include "section.hpp"
#include "subject.hpp"

namespace measure {

class PaperMeasurer {
 public:
  explicit PaperMeasurer(const Settings& settings)
      : settings_(settings), repetitions_(settings.repetitions) {}

  const Settings& settings() const { return settings_; }
  /// Takes fewer samples from now on, for curves of many points.
  void take_fewer_samples();

  /// Returns all values, or the first two for --quick.
  template <typename Value>
  std::vector<Value> some(std::vector<Value> values) const {
    if (settings_.quick && values.size() > 2) values.resize(2);
    return values;
  }

  /// Returns {"design", "primitives", "pixels", "hits", "rules": [RULE, …]}. Throws WrongAnswer.
  nlohmann::json rules(const Subject& subject, const csgcore::View& view,
                       const std::vector<bench::Rule>& rules);
  /// Returns a POINT.
  nlohmann::json point(const Subject& subject, const csgcore::View& view);

  /// "gl: " and GL_RENDERER; empty until something was measured by it.
  const std::string& opengl() const { return opengl_; }
  const std::vector<std::string>& left_out() const { return left_out_.reasons; }

 private:
  const Settings& settings_;
  Repetitions repetitions_;
  std::string opengl_;
  LeftOut left_out_;
};

/// Returns the exponent b of time ≈ a · cones^b, by least squares of the logarithms, for the
/// medians at `path` in the rules of that index; null if there are none.
nlohmann::json growth_exponent(const nlohmann::json& points, size_t rule, const std::string& path);

/// The camera goes back, so that the same cells cover fewer pixels.
nlohmann::json sweep_area(PaperMeasurer& measurer);
/// The camera goes aside, so that fewer cells are in view.
nlohmann::json sweep_cells_in_view(PaperMeasurer& measurer);
/// The design is repeated behind itself, without perspective, so that the same pixels are covered.
nlohmann::json sweep_depth(PaperMeasurer& measurer);

}  // namespace measure
