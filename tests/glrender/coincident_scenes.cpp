#include "coincident_scenes.hpp"

#include <utility>

namespace gl_test {
namespace {

using csgcore::Affine;
using csgcore::make_frustum;
using csgcore::make_sphere;
using csgcore::Op;
using csgcore::Primitive;

/// Writes a scene as text would: operations opened and closed around primitives.
class SceneWriter {
 public:
  explicit SceneWriter(const Affine& frame) : frame_(frame) {}

  SceneWriter& open(Op op) {
    tree_.open(op);
    return *this;
  }
  SceneWriter& add(Primitive primitive) {
    const auto index = static_cast<uint32_t>(scene_.primitives.size());
    primitive.id = index;
    primitive.local_to_world = csgcore::compose(frame_, primitive.local_to_world);
    scene_.primitives.push_back(primitive);
    tree_.primitive(index);
    return *this;
  }
  SceneWriter& close() {
    tree_.close();
    return *this;
  }
  NamedScene finish(std::string name, double face_z) {
    scene_.model = tree_.finish();
    NamedScene named{std::move(name), face_z, std::move(scene_)};
    scene_ = {};
    return named;
  }

 private:
  Affine frame_;
  csgcore::Scene scene_;
  csgcore::CsgTreeBuilder tree_;
};

Primitive rod(double from, double to, double radius) {
  return make_frustum(from, to, radius, radius);
}

Primitive beside(Primitive primitive, double x) {
  primitive.local_to_world.translation.x = x;
  return primitive;
}

void add_flush_caps(SceneWriter& write, std::vector<NamedScene>& all) {
  const auto difference = [&]() -> SceneWriter& { return write.open(Op::kDifference); };
  all.push_back(difference().add(rod(0, 5, 5)).add(rod(0, 5, 2)).close().finish("hole", 5));
  all.push_back(difference().add(rod(0, 5, 5)).add(rod(2, 5, 3)).close().finish("blind hole", 5));
  all.push_back(difference().add(rod(0, 5, 5)).add(rod(5, 7, 3)).close().finish("cut above", 5));
  all.push_back(difference()
                    .add(rod(0, 5, 5))
                    .add(rod(0, 2, 3))
                    .add(rod(2, 5, 3))
                    .close()
                    .finish("hole of two", 2));
  all.push_back(difference()
                    .add(rod(0, 5, 5))
                    .add(make_frustum(0, 2.5, 3, 1))
                    .add(make_frustum(2.5, 5, 1, 3))
                    .close()
                    .finish("hourglass", 5));
  all.push_back(write.open(Op::kIntersection)
                    .add(rod(0, 5, 5))
                    .add(rod(-2, 5, 4))
                    .add(make_frustum(-1, 5, 6, 3))
                    .close()
                    .finish("common top", 5));
}

void add_shared_tops(SceneWriter& write, std::vector<NamedScene>& all) {
  all.push_back(write.add(rod(0, 2, 5)).add(rod(0, 2, 3)).finish("common faces", 2));
  all.push_back(write.add(rod(0, 2, 5)).add(rod(2, 4, 5)).add(rod(4, 6, 3)).finish("stack", 2));
  write.open(Op::kDifference).add(rod(0, 2, 5)).add(rod(1, 2, 3)).close();
  all.push_back(write.add(rod(1, 2, 3)).finish("inlay", 2));
  // Either inlay would do without the other; the plate, which is cut away there, would not.
  write.open(Op::kDifference).add(rod(0, 2, 5)).add(rod(1, 2, 3)).close();
  all.push_back(write.add(rod(1, 2, 3)).add(rod(0, 2, 2)).finish("two inlays", 2));
  for (int i = 0; i < 12; ++i) write.add(beside(rod(0.1 * i, 3, 2), 0.6 * i - 3));
  all.push_back(write.finish("twelve tops", 3));
  // More primitives than the shaders keep bits for.
  write.open(Op::kDifference).add(rod(0, 3, 5)).add(rod(1, 3, 3)).close();
  for (int i = 0; i < 40; ++i) write.add(rod(0.02 * i, 3, 3));
  all.push_back(write.finish("forty inlays", 3));
  write.open(Op::kDifference);
  for (int i = 0; i < 6; ++i) write.add(beside(rod(0.1 * i, 3, 2), 0.6 * i - 1.5));
  for (int i = 0; i < 6; ++i) write.add(beside(rod(1 + 0.2 * i, 3, 1), 0.7 * i - 2));
  all.push_back(write.close().finish("six flush cuts", 3));
}

void add_shared_walls(SceneWriter& write, std::vector<NamedScene>& all) {
  const auto difference = [&]() -> SceneWriter& { return write.open(Op::kDifference); };
  all.push_back(
      difference().add(rod(0, 5, 5)).add(rod(1, 6, 5)).close().finish("disc left over", 1));
  all.push_back(write.open(Op::kIntersection)
                    .add(rod(0, 5, 4))
                    .add(rod(-2, 3, 4))
                    .close()
                    .finish("common wall", 3));
  all.push_back(write.add(rod(0, 3, 4)).add(rod(1, 5, 4)).finish("overlapping rods", 5));
  difference().add(rod(0, 5, 5)).add(rod(-1, 6, 4)).close();
  all.push_back(write.add(rod(1, 4, 4)).finish("plug", 4));
  difference().add(make_frustum(0, 6, 5, 2)).add(make_frustum(1, 7, 4.5, 1.5)).close();
  all.push_back(write.add(make_frustum(3, 6, 3.5, 2)).finish("cones of one slope", 6));
}

void add_shells(SceneWriter& write, std::vector<NamedScene>& all) {
  write.open(Op::kDifference);
  for (int radius = 5; radius >= 3; --radius) {
    write.open(Op::kDifference).add(make_sphere(radius)).add(make_sphere(radius - 1)).close();
  }
  all.push_back(write.close().finish("shell less shells", 0));
  // Nested shells without gaps between them, cut open.
  write.open(Op::kDifference).open(Op::kUnion);
  for (int radius = 5; radius >= 3; --radius) {
    write.open(Op::kDifference).add(make_sphere(radius)).add(make_sphere(radius - 1)).close();
  }
  all.push_back(write.close().add(rod(0, 6, 6)).close().finish("shells cut open", 0));
  all.push_back(write.add(make_sphere(5)).add(make_sphere(5)).finish("equal balls", 0));
  write.open(Op::kDifference).add(rod(-5, 0, 6)).add(make_sphere(4)).close();
  all.push_back(write.add(make_sphere(4)).finish("ball in its socket", 0));
  all.push_back(write.open(Op::kDifference)
                    .add(make_sphere(5))
                    .add(make_sphere(5))
                    .close()
                    .finish("nothing left", 0));
}

}  // namespace

std::vector<NamedScene> coincident_scenes(const Affine& frame) {
  std::vector<NamedScene> all;
  SceneWriter write(frame);
  add_flush_caps(write, all);
  add_shared_tops(write, all);
  add_shared_walls(write, all);
  add_shells(write, all);
  return all;
}

}  // namespace gl_test
