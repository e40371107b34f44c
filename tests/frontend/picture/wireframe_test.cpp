// Tests how a wireframe is drawn, against OpenSCAD 2021.01's PNGs.
#include "frontend/wireframe.hpp"

#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "frontend/color_scheme.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Vec3;
using testing::ElementsAre;

class Wireframe : public testing::Test {
 protected:
  // 400×400 pixels, orthographic, seen from above: 20 units are 201.1 pixels.
  Wireframe() {
    options_.width_px = options_.height_px = 400;
    options_.projection = csgcore::Projection::kOrthographic;
    camera_.rotation_deg = {0, 0, 0};
    camera_.distance = 100;
  }
  Image draw(const SolidEdges& edges, float z = std::numeric_limits<float>::infinity()) {
    Image image;
    image.width_px = image.height_px = 400;
    image.rgb.assign(400 * 400, {0, 0, 0});
    image.z.assign(image.rgb.size(), z);
    draw_wireframe(image, make_view(camera_, options_), camera_, edges, color_schemes().front());
    return image;
  }
  static std::string row(const Image& image, std::size_t y, std::size_t from, std::size_t to) {
    std::string text;
    for (std::size_t x = from; x < to; ++x) {
      const auto& c = image.rgb[y * 400 + x];
      using Color = std::array<uint8_t, 3>;
      text += c == Color{0xff, 0xec, 0x5e}   ? 'f'
              : c == Color{0xff, 0xf6, 0x7c} ? 'F'
              : c == Color{0xab, 0xd8, 0x56} ? 'b'
              : c == Color{0xb7, 0xe8, 0x5c} ? 'B'
                                             : '.';
    }
    return text;
  }
  Camera camera_;
  CameraOptions options_;
};

TEST_F(Wireframe, LinesAreFivePixelsWideAndVerticesTen) {
  SolidEdges edges;
  edges.vertices = {{{-10, 3, 10}, true}};
  edges.edges = {{{-10, 10, 10}, {-10, -10, 10}, false}, {{-10, 3, 10}, {10, 3, 10}, true}};
  const Image image = draw(edges);
  std::vector<std::string> rows;
  for (std::size_t y = 163; y < 177; ++y) rows.push_back(row(image, y, 92, 110));
  EXPECT_THAT(rows, ElementsAre(".....fffff........", ".....fffff........", "..BBBfffffBB......",
                                "..BBBfffffBB......", "..BBBffbbbbbbbbbbb", "..BBBffbbbbbbbbbbb",
                                "..BBBffbbbbbbbbbbb", "..BBBffbbbbbbbbbbb", "..BBBffbbbbbbbbbbb",
                                "..BBBfffffBB......", "..BBBfffffBB......", "..BBBfffffBB......",
                                ".....fffff........", ".....fffff........"));
}

TEST_F(Wireframe, WhatIsNearerIsInFront) {
  SolidEdges edges;
  edges.edges = {{{-10, 0, 10}, {10, 0, 10}, true}, {{0, -10, 0}, {0, 10, 0}, false}};
  EXPECT_EQ(row(draw(edges), 200, 195, 205), "bbbbbbbbbb");
  std::swap(edges.edges[0], edges.edges[1]);
  EXPECT_EQ(row(draw(edges), 200, 195, 205), "bbbbbbbbbb");
  EXPECT_EQ(row(draw(edges, 50), 200, 195, 205), "..........") << "a surface is in front";
}

}  // namespace
}  // namespace frontend
