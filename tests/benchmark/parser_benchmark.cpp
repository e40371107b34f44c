// Measures how fast a .csg becomes a syntax tree (issue 2: at least 100 MB/s on cs10000.csg), and a
// scene.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"

namespace {

/// A cylinder minus `spheres` spheres as OpenSCAD writes it, with numbers of 1 to 6 digits.
std::string carved_cylinder(int spheres) {
  std::string text =
      "difference() {\n"
      "\tcylinder($fn = 0, $fa = 12, $fs = 2, h = 20, r1 = 10, r2 = 10, center = true);\n"
      "\tgroup() {\n";
  for (int i = 0; i < spheres; ++i) {
    char node[256];
    std::snprintf(node, sizeof node,
                  "\t\tmultmatrix([[1, 0, 0, %g], [0, 1, 0, %g], [0, 0, 1, %g], [0, 0, 0, 1]]) {\n"
                  "\t\t\tsphere($fn = 0, $fa = 12, $fs = 2, r = 0.632456);\n\t\t}\n",
                  10 * std::cos(i), 10 * std::sin(i), i % 2000 * 0.01 - 10);
    text += node;
  }
  return text + "\t}\n}\n";
}

void parse_carved_cylinder(benchmark::State& state) {
  const int spheres = static_cast<int>(state.range(0));
  const std::string text = carved_cylinder(spheres);
  const size_t nodes = 3 + 2 * static_cast<size_t>(spheres);
  for (auto _ : state) {
    const frontend::SyntaxTree tree = frontend::parse(text, "carved.csg");
    if (tree.nodes.size() != nodes) state.SkipWithError("wrong number of nodes");
  }
  state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(text.size()));
}
BENCHMARK(parse_carved_cylinder)
    ->Arg(100)
    ->Arg(10'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond);

/// Makes a scene of the same text: `parse` and `import` of --stats.
void import_carved_cylinder(benchmark::State& state) {
  const int spheres = static_cast<int>(state.range(0));
  const std::string text = carved_cylinder(spheres);
  for (auto _ : state) {
    const frontend::ImportedDesign design =
        frontend::import_design(frontend::parse(text, "carved.csg"));
    if (design.primitive_nodes != 1 + static_cast<uint32_t>(spheres)) {
      state.SkipWithError("wrong number of primitives");
    }
  }
  state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(text.size()));
}
BENCHMARK(import_carved_cylinder)
    ->Arg(100)
    ->Arg(10'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond);

/// Parses rotations, in which every number has six digits and a sign or an exponent.
void parse_rotations(benchmark::State& state) {
  std::string text;
  for (int i = 0; i < 10'000; ++i) {
    text +=
        "multmatrix([[0.925417, -0.173648, 0.336824, 1e-07], [0.163176, 0.984808, 0.0593912, "
        "-3.2], [-0.34202, 0, 0.939693, 1.23457e+06], [0, 0, 0, 1]]) {\n"
        "\tcylinder($fn = 0, $fa = 12, $fs = 2, h = 0.252982, r1 = 0, r2 = 0.26, center = "
        "false);\n}\n";
  }
  for (auto _ : state) {
    const frontend::SyntaxTree tree = frontend::parse(text, "rotations.csg");
    if (tree.nodes.size() != 20'000) state.SkipWithError("wrong number of nodes");
  }
  state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(text.size()));
}
BENCHMARK(parse_rotations)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
