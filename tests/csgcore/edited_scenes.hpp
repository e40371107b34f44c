// Designs that are edited: what somebody does to a file between two saves.
#pragma once

#include <random>
#include <vector>

#include "csgcore/scene.hpp"

namespace csgcore::checks {

/// A design as a file has it: nodes of operations and primitives, in file order.
class Design {
 public:
  /// The scene's model.
  explicit Design(const Scene& scene);

  /// One primitive is replaced, moved a little, inserted into some operation, removed or
  /// recoloured; or, rarely, an operation becomes another one.
  void edit(std::mt19937& random);
  void move(std::mt19937& random);
  void insert(std::mt19937& random);
  void remove(std::mt19937& random);
  void recolor(std::mt19937& random);
  void change_operation(std::mt19937& random);

  /// Ids, and indices, are those in file order.
  Scene scene() const;
  /// The same as a part of a scene.
  void build(std::vector<Primitive>& primitives, CsgTreeBuilder& builder) const;

 private:
  /// Of a tree in prefix order: each node is followed by its operands.
  struct Node {
    bool is_primitive = false;
    Op op = Op::kUnion;
    uint32_t size = 1;  // nodes of the subtree, this one among them
    Primitive primitive;
  };
  std::vector<size_t> places_of(bool primitives) const;
  void resize_around(size_t place, int by);

  std::vector<Node> nodes_;
};

/// A random tree whose bounds stay the same while most of its parts are edited: it is cut out of a
/// ball, or stands between two balls far apart.
Scene framed_tree(uint32_t primitives, uint32_t seed);

}  // namespace csgcore::checks
