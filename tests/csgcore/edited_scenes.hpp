// Designs that are edited as a person edits a file between two saves.
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

  /// Makes a random edit: replaces, inserts into some operation, removes or recolours a primitive,
  /// or moves it a little; or, rarely, exchanges an operation.
  void edit(std::mt19937& random);
  void move(std::mt19937& random);
  void insert(std::mt19937& random);
  void remove(std::mt19937& random);
  void recolor(std::mt19937& random);
  void change_operation(std::mt19937& random);

  /// Returns the scene, whose ids and indices are in file order.
  Scene scene() const;
  /// Builds the design as a part of a scene.
  void build(std::vector<Primitive>& primitives, CsgTreeBuilder& builder) const;

 private:
  /// A node of a tree in prefix order, in which each node is followed by its operands.
  struct Node {
    bool is_primitive = false;
    Op op = Op::kUnion;
    uint32_t size = 1;  // nodes of the subtree, itself included
    Primitive primitive;
  };
  std::vector<size_t> places_of(bool primitives) const;
  void resize_around(size_t place, int by);

  std::vector<Node> nodes_;
};

/// A random tree whose bounds stay the same while most of its parts are edited: it is cut out of a
/// ball, or is between two balls far from each other.
Scene framed_tree(uint32_t primitives, uint32_t seed);

}  // namespace csgcore::checks
