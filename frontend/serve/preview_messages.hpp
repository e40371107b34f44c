// The forms of the preview's protocol (PREVIEW.md).
#pragma once

#include <functional>
#include <string>

#include "preview.hpp"
#include "protocol.hpp"

namespace serve {

/// How the client names and counts places.
struct PlaceForms {
  PositionEncoding encoding = PositionEncoding::kUtf16;
  /// Of a file; an empty path is the document's own.
  std::function<std::string(const std::string& path)> uri_of;
};

/// Returns a member that is a number in a range. Throws RequestError.
double number_of(const Json& json, const char* name, double least, double most);

/// Throw RequestError.
window::Navigation navigation_of(const Json& json);
/// Changes what the JSON names.
void change_look(const Json& json, Look& look);
/// Gives parameters values by their names.
void change_parameters(const Json& values, window::Customizer& customizer);
/// Returns the part of a picture that insets leave.
window::PicturePart part_of(const Json& insets, window::Size size);

Json json_of(const window::Navigation& navigation);
/// The design as the client is told of it. `now` is the camera that it is seen by.
Json json_of(const DesignReading& reading, const window::Customizer& customizer,
             const window::Navigation& now, const PlaceForms& places);
/// What is seen at a place; null: nothing.
Json json_of(const window::Finding& finding, const PlaceForms& places);
/// The parameters of `scadray/frame`, without the image.
Json json_of(const PreviewFrame& frame, uint64_t preview);

}  // namespace serve
