// What an evaluation shows, with a cache and without one.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "language/csg_writer.hpp"
#include "language/evaluation.hpp"
#include "language/evaluation_cache.hpp"
#include "syntax/parsed_design.hpp"

namespace language {

struct Shown {
  Evaluation evaluation;
  Lines lines;
  Lines places;  // of all nodes, as path, line and column
};

inline Lines places_of(const Evaluation& evaluation) {
  const SourceFiles& files = *evaluation.files;
  Lines places;
  for (uint32_t i = 0; i < evaluation.tree->size(); ++i) {
    const Node& node = evaluation.tree->nodes[i];
    if (node.place.file == kNoFile || !files.has(node.place.file)) continue;
    places.push_back(
        files[node.place.file].path + ":" + std::to_string(files.message_line(node.place)) + ":" +
        std::to_string(files.line(node.place)) + ":" + std::to_string(files.column(node.place)) +
        ":" + std::to_string(node.place.offset) + " " + std::string(name_of(node.kind)));
  }
  return places;
}

inline Shown shown(EvaluationCache* cache) {
  EvaluationOptions options;
  options.cache = cache;
  Shown shown;
  shown.evaluation = evaluate("main.scad", options,
                              [&](std::string_view line) { shown.lines.emplace_back(line); });
  shown.places = places_of(shown.evaluation);
  return shown;
}

/// Returns the tree as text: numbers of files differ between caches.
inline std::string text_of(const Evaluation& evaluation) { return csg_text(*evaluation.tree); }

/// Compares an evaluation of main.scad that uses a cache with one that does not.
inline void expect_same(EvaluationCache& cache) {
  const Shown kept = shown(&cache), fresh = shown(nullptr);
  EXPECT_EQ(kept.evaluation.outcome, fresh.evaluation.outcome);
  EXPECT_EQ(text_of(kept.evaluation), text_of(fresh.evaluation));
  EXPECT_EQ(kept.lines, fresh.lines);
  EXPECT_EQ(kept.places, fresh.places);
  EXPECT_EQ(kept.evaluation.files_read, fresh.evaluation.files_read);
  EXPECT_EQ(kept.evaluation.lookups, fresh.evaluation.lookups);
  EXPECT_EQ(kept.evaluation.camera.distance, fresh.evaluation.camera.distance);
}

}  // namespace language
