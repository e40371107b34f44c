// Which elements of an SVG are drawn (svg.cpp).
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "csgcore/stop_scope.hpp"
#include "drawings/svg.hpp"

namespace frontend {
namespace {

bool is_shape(std::string_view name) {
  constexpr std::array<std::string_view, 7> kShapes = {"path", "rect",     "circle", "ellipse",
                                                       "line", "polyline", "polygon"};
  return std::ranges::find(kShapes, name) != kShapes.end();
}

/// What an element hands down.
struct Scope {
  PlaneMap map;
  bool is_hidden = false;  // by `display`
  bool is_in_layer = false;
  bool is_chosen = false;  // by its id
};

/// Walks the document, in its order, and the elements that are used.
class Walk {
 public:
  Walk(const pugi::xml_node& root, const std::string& name, const SvgSettings& settings,
       const std::function<void(const pugi::xml_node&)>& take_page,
       std::vector<DrawingProblem>& problems)
      : root_(root),
        name_(name),
        settings_(settings),
        take_page_(take_page),
        problems_(problems),
        dialect_(settings.language) {}

  std::vector<SvgElement> run() {
    steps_.push_back({Step::kEnter, root_, {}});
    while (!steps_.empty()) {
      csgcore::stop_point();
      const Step step = std::move(steps_.back());
      steps_.pop_back();
      if (step.kind == Step::kLeave) {
        if (std::string_view(step.node.name()) == "defs") is_in_defs_ = false;
      } else if (step.kind == Step::kEndUse) {
        used_.erase(step.node);
      } else {
        enter(step);
      }
    }
    tell_problems();
    return std::move(drawn_);
  }

 private:
  static constexpr size_t kMostUsedBytes = 1 << 23;  // their curves have some 100 MB

  struct Step {
    enum Kind : uint8_t { kEnter, kUse /* enter without what follows */, kLeave, kEndUse } kind;
    pugi::xml_node node;
    Scope scope;  // of the nodes around
  };

  void enter(const Step& step) {
    const pugi::xml_node& node = step.node;
    if (!used_.empty() && !afford(node)) return;
    if (step.kind == Step::kEnter && node != root_ && node.next_sibling()) {
      steps_.push_back({Step::kEnter, node.next_sibling(), step.scope});
    }
    const std::string_view name = node.name();
    if (name == "defs") is_in_defs_ = static_cast<bool>(node.first_child());
    if (name == "svg") take_page_(node);
    const bool is_used_alone = step.kind == Step::kUse && name != "g";
    const size_t place = steps_.size();
    if (node.first_child() && !is_used_alone) {
      steps_.push_back({Step::kLeave, node, {}});
      steps_.push_back({Step::kEnter, node.first_child(), step.scope});
    }
    if (!is_shape(name) && name != "g" && name != "use" && name != "text") return;
    if (is_in_defs_) return define(node, name);
    const Scope own = scope_of(node, step.scope);
    if (name == "g" && steps_.size() > place) steps_.back().scope = own;
    if (name == "use" && dialect_.chooses_elements) use(node, own);
    if (is_shape(name) && is_shown(own)) drawn_.push_back({node, own.map});
  }

  Scope scope_of(const pugi::xml_node& node, const Scope& around) {
    Scope own = around;
    if (node != root_) {
      own.map = compose(around.map, read_svg_transform(node.attribute("transform").value()));
    }
    if (!dialect_.chooses_elements) return own;
    if (svg_style(node, "display", dialect_) == "none") own.is_hidden = true;
    const bool is_layer = settings_.layer &&
                          *settings_.layer == node.attribute("inkscape:label").value() &&
                          std::string_view(node.attribute("inkscape:groupmode").value()) == "layer";
    if (is_layer) own.is_in_layer = true;
    const bool has_id = settings_.id && node.attribute("id") &&
                        *settings_.id == node.attribute("id").value() &&
                        (own.is_in_layer || !settings_.layer);
    if (has_id) own.is_chosen = true;
    if (settings_.id ? has_id : is_layer) {
      own.is_hidden = false;
      has_match_ = true;
    }
    return own;
  }

  bool is_shown(const Scope& scope) const {
    if (scope.is_hidden) return false;
    if (settings_.id) return scope.is_chosen || !dialect_.chooses_elements;
    return scope.is_in_layer || !settings_.layer || !dialect_.chooses_elements;
  }

  void define(const pugi::xml_node& node, std::string_view name) {
    const pugi::xml_attribute id = node.attribute("id");
    if (dialect_.chooses_elements && id && name != "text") defined_.try_emplace(id.value(), node);
  }

  static std::string_view reference_of(const pugi::xml_node& use) {
    if (const pugi::xml_attribute own = use.attribute("href")) return own.value();
    return use.attribute("xlink:href").value();
  }

  void use(const pugi::xml_node& node, Scope scope) {
    std::string_view reference = reference_of(node);
    if (reference.empty()) return;
    if (!reference.starts_with('#')) {
      if (bad_use_.empty()) {
        bad_use_ =
            std::string("<use> can only use references to ids in the href field (starting ") +
            "with #). Error in element type use with id: " + node.attribute("id").value();
      }
      return;
    }
    reference.remove_prefix(1);
    const auto found = defined_.find(reference);
    // What uses itself is not drawn.
    if (found == defined_.end() || !used_.insert(found->second).second) return;
    const PlaneMap place{glm::dmat2(1.0), {svg_number(node, "x"), svg_number(node, "y")}};
    scope.map = compose(scope.map, place);
    steps_.push_back({Step::kEndUse, found->second, {}});
    steps_.push_back({Step::kUse, found->second, scope});
  }

  /// Counts an element that is used. Few of a document take no longer than its text; uses of uses
  /// may be beyond any number.
  bool afford(const pugi::xml_node& node) {
    constexpr size_t kElement = 16;
    constexpr std::array<const char*, 2> kTexts = {"d", "points"};
    used_bytes_ += kElement;
    for (const char* const text : kTexts) {
      used_bytes_ += std::string_view(node.attribute(text).value()).size();
    }
    return used_bytes_ <= kMostUsedBytes;
  }

  void tell_problems() {
    if (used_bytes_ > kMostUsedBytes) {
      problems_.push_back(
          {"Uses in '" + name_ + "' are left out: they draw too much", "use fewer uses of uses"});
    }
    if (!bad_use_.empty()) problems_.push_back({bad_use_, "name an element of the file's defs"});
    if (!dialect_.chooses_elements || has_match_ || (!settings_.id && !settings_.layer)) return;
    std::string filter;
    if (settings_.id) filter += "id = \"" + *settings_.id + "\"";
    if (settings_.id && settings_.layer) filter += ", ";
    if (settings_.layer) filter += "layer = \"" + *settings_.layer + "\"";
    problems_.push_back({"import() filter " + filter + " did not match anything",
                         "name an id, or the label of a layer, of '" + name_ + "'"});
  }

  struct ByAddress {
    bool operator()(const pugi::xml_node& a, const pugi::xml_node& b) const {
      return std::less<>()(a.internal_object(), b.internal_object());
    }
  };

  const pugi::xml_node root_;
  const std::string& name_;
  const SvgSettings& settings_;
  const std::function<void(const pugi::xml_node&)>& take_page_;
  std::vector<DrawingProblem>& problems_;
  const SvgDialect dialect_;
  std::vector<Step> steps_;  // to be taken, the next one last
  bool is_in_defs_ = false;
  std::map<std::string, pugi::xml_node, std::less<>> defined_;  // by id
  std::set<pugi::xml_node, ByAddress> used_;                    // around the node at hand
  size_t used_bytes_ = 0;
  bool has_match_ = false;
  std::string bad_use_;  // the first message
  std::vector<SvgElement> drawn_;
};

}  // namespace

std::vector<SvgElement> drawn_svg_elements(
    const pugi::xml_node& root, const std::string& name, const SvgSettings& settings,
    const std::function<void(const pugi::xml_node&)>& take_page,
    std::vector<DrawingProblem>& problems) {
  return Walk(root, name, settings, take_page, problems).run();
}

}  // namespace frontend
