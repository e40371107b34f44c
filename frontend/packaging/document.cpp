// scadray-document PROGRAM VERSION TEMPLATE FILE: writes a manual page, or a shell's completion, of
// scadray or of one of the programs that it runs. TEMPLATE's suffix before ".in" says which. In it,
// @program@ stands for the program's name, @options@ for the lines from the option table, and so
// on. The build runs it.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "bench/options.hpp"
#include "command/option_row.hpp"
#include "program.hpp"
#include "serve/options.hpp"
#include "validate/options.hpp"

namespace packaging {
namespace {

Program program_of(const std::string& name) {
  if (name == "scadray") {
    return {"scadray",
            "bench serve validate",
            {{"OpenSCAD's options", frontend::openscad_options()},
             {"scadray's own options", frontend::own_options()}}};
  }
  if (name == "scadray-bench") return {"scadray-bench", "", {{"Options", bench::option_rows()}}};
  if (name == "scadray-serve") return {"scadray-serve", "", {{"Options", serve::option_rows()}}};
  if (name == "scadray-validate") {
    return {"scadray-validate", "", {{"Options", validation::option_rows()}}};
  }
  throw std::runtime_error("no program " + name);
}

std::string options_of(const Program& program, const std::string& template_path) {
  const std::pair<const char*, std::string (*)(const Program&)> kinds[] = {
      {".1.in", manual_options},
      {".bash.in", bash_options},
      {".zsh.in", zsh_options},
      {".fish.in", fish_options}};
  for (const auto& [suffix, options] : kinds) {
    if (template_path.ends_with(suffix)) return options(program);
  }
  throw std::runtime_error(template_path + ": no known suffix");
}

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file || text.empty()) throw std::runtime_error(path + ": cannot be read");
  return text;
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

void run(const Program& program, const std::string& version, const std::string& template_path,
         const std::string& path) {
  std::string text = read(template_path);
  replace_all(text, "@options@\n", options_of(program, template_path));
  replace_all(text, "@program@", program.name);
  replace_all(text, "@function@", function_of(program));
  replace_all(text, "@subcommands@", program.subcommands);
  replace_all(text, "@version@", version);
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace
}  // namespace packaging

int main(int argc, char** argv) {
  try {
    if (argc != 5)
      throw std::runtime_error("usage: scadray-document PROGRAM VERSION TEMPLATE FILE");
    packaging::run(packaging::program_of(argv[1]), argv[2], argv[3], argv[4]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scadray-document: error: %s\n", error.what());
    return 1;
  }
}
