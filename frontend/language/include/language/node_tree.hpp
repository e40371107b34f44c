// The tree of nodes that a design evaluates to, or that a .csg holds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include "language/node_kind.hpp"
#include "language/source_files.hpp"
#include "language/value.hpp"

namespace language {

/// A std::vector for elements that may be moved as bytes, because they do not refer to their own
/// place: a large block grows by realloc(), which moves pages instead of copying and touching them.
template <typename Element>
class GrowingArray {
 public:
  GrowingArray() = default;
  GrowingArray(GrowingArray&& other) noexcept { swap(other); }
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    GrowingArray(std::move(other)).swap(*this);
    return *this;
  }
  ~GrowingArray() {
    std::destroy_n(data_, size_);
    std::free(static_cast<void*>(data_));
  }
  void swap(GrowingArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  size_t size() const { return size_; }
  Element* data() { return data_; }
  const Element* data() const { return data_; }
  Element& operator[](size_t index) { return data_[index]; }
  const Element& operator[](size_t index) const { return data_[index]; }
  Element& back() { return data_[size_ - 1]; }
  const Element* begin() const { return data_; }
  const Element* end() const { return data_ + size_; }

  void push_back(Element element) {
    if (size_ == capacity_) grow(1);
    std::construct_at(data_ + size_++, std::move(element));
  }
  /// The elements must not be the array's own.
  void append(std::span<const Element> elements) {
    if (capacity_ - size_ < elements.size()) grow(elements.size());
    std::uninitialized_copy(elements.begin(), elements.end(), data_ + size_);
    size_ += elements.size();
  }
  /// Removes all elements from `size` on.
  void truncate(size_t size) {
    std::destroy_n(data_ + size, size_ - size);
    size_ = size;
  }

 private:
  void grow(size_t count) {
    constexpr size_t kLeast = 64;
    const size_t capacity = std::max({kLeast, 2 * capacity_, size_ + count});
    void* const block = std::realloc(static_cast<void*>(data_), capacity * sizeof(Element));
    if (block == nullptr) throw std::bad_alloc();
    data_ = static_cast<Element*>(block);
    capacity_ = capacity;
  }

  Element* data_ = nullptr;
  size_t size_ = 0;
  size_t capacity_ = 0;
};

/// How the .csg writer spells an argument (LANGUAGE.md, "Builtin modules").
enum class ArgumentStyle : uint8_t {
  kGeneral,        // "%g" numbers, vectors as [G, G]
  kGeneralTight,   // the same without blanks: [G,G,G]
  kEcho,           // as echo() spells values
  kMatrix,         // 16 numbers: four rows, as echo() spells them
  kGeneralMatrix,  // the same by "%g"
  kGeneralLists,   // a vector, or one of vectors, of numbers by "%g"
  kGeneralSpaced,  // numbers with a blank before each: [ G, G]
  kInteger,        // a whole number, with all of its digits
  kRawString,      // in quotes, nothing escaped
  kEscapedString,  // in quotes, with \t \n \r \" \\ escaped
};

struct NodeArgument {
  ArgumentName name;
  ArgumentStyle style = ArgumentStyle::kGeneral;
  uint16_t number_count = 0;  // not 0: the argument is that many of the tree's numbers
  uint32_t first_number = 0;
  Value value{};  // undef if numbers stand in its place
};
static_assert(sizeof(NodeArgument) == 24);

struct Node {
  Place place;  // of the module call that made it; in a .csg, of its name
  uint32_t first_argument = 0;
  uint32_t end = 0;  // index behind its last descendant
  NodeKind kind = NodeKind::kGroup;
  uint8_t modifiers = 0;        // CallModifier
  bool is_module_call = false;  // of a module that the design itself defines
  bool has_lists = false;       // of lazy unions: it is written with braces, also if they are empty
};
static_assert(sizeof(Node) == 20);

/// Nodes in preorder: the first child of node i is i + 1, the sibling behind child c is
/// nodes[c].end, and the last child's end is nodes[i].end. The design's top-level nodes begin at 0.
/// Arguments and numbers are in the order of their nodes, so whatever is taken off the end of the
/// tree is the last that was added.
struct NodeTree {
  GrowingArray<Node> nodes;
  GrowingArray<NodeArgument> arguments;
  GrowingArray<double> numbers;
  /// Whether numbers are the design's own doubles. Those of a .csg have six digits.
  bool has_all_digits = true;

  /// Returns the arguments of a node of this tree in the order in which .csg lists them.
  std::span<const NodeArgument> arguments_of(const Node& node) const {
    const bool is_last = &node == nodes.end() - 1;
    const size_t end = is_last ? arguments.size() : (&node)[1].first_argument;
    return {arguments.data() + node.first_argument, end - node.first_argument};
  }
  std::span<const double> numbers_of(const NodeArgument& argument) const {
    return {numbers.data() + argument.first_number, argument.number_count};
  }
  uint32_t size() const { return static_cast<uint32_t>(nodes.size()); }
  /// Returns what the tree takes, without the strings and vectors of its arguments.
  size_t bytes() const {
    return nodes.size() * sizeof(Node) + arguments.size() * sizeof(NodeArgument) +
           numbers.size() * sizeof(double);
  }

  /// Adds a node behind all others. Its end is not known yet.
  uint32_t open(NodeKind kind, uint8_t modifiers, Place place);
  /// All nodes behind it are its descendants.
  void close(uint32_t node) { nodes[node].end = size(); }
  /// Returns the node with its descendants as a tree of its own, which shares values with this one.
  NodeTree subtree(uint32_t node) const;
  /// Removes a node that is open, or the last that was closed, with its descendants.
  void remove(uint32_t node);
  /// Adds an argument to the last node.
  void add(ArgumentName name, Value value, ArgumentStyle style);
  /// The same with numbers in place of the value, of which there must be 1 to kMostNumbers.
  void add(ArgumentName name, std::span<const double> values, ArgumentStyle style);
  static constexpr size_t kMostNumbers = 0xFFFF;
};

/// What a tree's root modifiers (!) ask for.
struct RootModifiers {
  std::optional<uint32_t> shown{};  // the first node that has one
  /// The first one after it that stems from another call: OpenSCAD warns of it.
  std::optional<Place> other{};
};

/// Finds the nodes with root modifiers.
RootModifiers root_modifiers(const NodeTree& tree);

}  // namespace language
