#include "subtrees/figure_tree.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::CsgTreeBuilder;
using csgcore::Op;
using csgcore::Vec3;

/// Writes the operations of a node, from the outside in.
class FigureTreeWriter {
 public:
  FigureTreeWriter(const SubtreeEvaluation& evaluation, FrameTree& frames)
      : subtree_(evaluation.subtree()), evaluation_(evaluation), frames_(frames) {}

  FigureTree write(uint32_t root, uint32_t frame) {
    const uint32_t end = subtree_.end_of(root);
    open_.push_back({end, frame, {}});
    const bool is_extrusion = subtree_.row(root).is_extrusion();
    if (is_extrusion && subtree_.drawing(root) != nullptr) {
      add_figures(root);
      return {std::move(figures_), builder_.finish()};
    }
    for (uint32_t i = root + (is_extrusion ? 1 : 0); i < end;) {
      close_until(i);
      i = enter(i);
    }
    close_until(end);
    return {std::move(figures_), builder_.finish()};
  }

 private:
  struct Open {
    uint32_t end;
    uint32_t frame;
    PlaneMap map;
  };

  void close_until(uint32_t position) {
    while (open_.size() > 1 && open_.back().end <= position) {
      open_.pop_back();
      builder_.close();
    }
  }

  /// Returns the node to look at next.
  uint32_t enter(uint32_t node) {
    const uint32_t end = subtree_.end_of(node);
    const Presence presence = evaluation_.presence(node);
    if (presence == Presence::kEmpty) builder_.empty();
    if (presence != Presence::kSolid) return end;
    const NodeData& data = subtree_.data(node);
    if (const auto* figure = std::get_if<FigureNode>(&data)) {
      add(*figure->figure, node, figure->fragments);
      return end;
    }
    if (const auto* text = std::get_if<TextNode>(&data)) {
      builder_.open(Op::kUnion);
      for (const PlacedGlyph& letter : text->letters) add(letter, node);
      builder_.close();
      return end;
    }
    if (std::holds_alternative<ProjectionNode>(data)) {
      add_operations(node);
      return end;
    }
    if (std::holds_alternative<FileMatrix>(data) || std::holds_alternative<ResizeArguments>(data)) {
      open(node, evaluation_.matrix(node));
    } else if (subtree_.drawing(node) != nullptr || subtree_.row(node).joins_figures) {
      add_figures(node);
      return end;
    } else {
      builder_.open(subtree_.row(node).op);
      open_.push_back({end, open_.back().frame, open_.back().map});
    }
    return node + 1;
  }

  void add_operations(uint32_t node) {
    const Operations<Figure>& operations = evaluation_.projection(node);
    builder_.open(Op::kUnion);
    rebuild(operations.tree.tokens(), builder_,
            [&](CsgTreeBuilder&, uint32_t index) { add(operations.parts[index], node, 0); });
    builder_.close();
  }

  /// Adds all figures of a node that was evaluated, or of a drawing.
  void add_figures(uint32_t node) {
    const ImportedDrawing* drawing = subtree_.drawing(node);
    const std::span<const Figure> figures =
        drawing != nullptr ? std::span<const Figure>(drawing->figures) : evaluation_.figures(node);
    builder_.open(Op::kUnion);
    for (const Figure& figure : figures) add(figure, node, 0);
    builder_.close();
  }

  void open(uint32_t node, const HealedMatrix& matrix) {
    builder_.open(Op::kUnion);
    open_.push_back({subtree_.end_of(node), frames_.add(open_.back().frame, matrix),
                     compose(open_.back().map, plane_part(matrix.map))});
  }

  void add(const Figure& figure, uint32_t node, int fragments) {
    builder_.primitive(static_cast<uint32_t>(figures_.size()));
    figures_.push_back({std::make_shared<const Figure>(figure), open_.back().map,
                        open_.back().frame, subtree_.id(node), fragments});
  }

  void add(const PlacedGlyph& letter, uint32_t node) {
    builder_.primitive(static_cast<uint32_t>(figures_.size()));
    figures_.push_back({letter.shape.figure, open_.back().map, open_.back().frame,
                        subtree_.id(node), 0, letter.place, letter.shape.profile});
  }

  const Subtree& subtree_;
  const SubtreeEvaluation& evaluation_;
  FrameTree& frames_;
  std::vector<Open> open_;
  CsgTreeBuilder builder_;
  std::vector<PlacedFigure> figures_;
};

}  // namespace

FigureTree figure_tree(const SubtreeEvaluation& evaluation, uint32_t node, uint32_t frame,
                       FrameTree& frames) {
  return FigureTreeWriter(evaluation, frames).write(node, frame);
}

FigureTree union_of(std::span<const Figure> figures, uint32_t frame, uint32_t id) {
  std::vector<PlacedFigure> parts;
  for (const Figure& figure : figures) {
    parts.push_back({std::make_shared<const Figure>(figure), {}, frame, id});
  }
  return union_of(std::move(parts));
}

Rectangle faceted_bounds(const PlacedFigure& placed) {
  if (placed.fragments == 0) return bounds_of(placed.place(), *placed.figure);
  Rectangle result;
  const Rectangle circle = bounds_of(*placed.figure);
  const double radius = std::get_if<Disc>(placed.figure.get()) != nullptr
                            ? std::get<Disc>(*placed.figure).radius
                            : circle.max.x;  // the first corner lies there
  for (const Vec2& corner : circle_polygon({Vec2(0.0), radius}, placed.fragments)) {
    result.merge(placed.map.point(corner));
  }
  return result;
}

Rectangle positive_bounds(const FigureTree& figures) {
  std::vector<Box> boxes;
  for (const PlacedFigure& placed : figures.parts) {
    const Rectangle bounds = bounds_of(placed.place(), *placed.figure);
    Box& box = boxes.emplace_back();
    if (bounds.empty()) continue;
    box.merge(Vec3(bounds.min, 0));
    box.merge(Vec3(bounds.max, 0));
  }
  const Box box = box_of_positive_leaves(figures.tree, boxes);
  return {Vec2(box.min.x, box.min.y), Vec2(box.max.x, box.max.y)};
}

}  // namespace frontend
