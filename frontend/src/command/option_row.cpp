#include "command/option_row.hpp"

namespace frontend {
namespace {

namespace po = boost::program_options;

/// Owned by the table that it is added to.
const po::value_semantic* value_of(const OptionRow& row) {
  switch (row.takes) {
    case Takes::kNothing:
      break;
    case Takes::kText:
      return po::value<std::string>()->value_name(row.value_name);
    case Takes::kTexts:
      return po::value<std::vector<std::string>>()->value_name(row.value_name);
    case Takes::kOptionalText:
      return po::value<std::string>()->value_name(row.value_name)->implicit_value("", "");
    case Takes::kCount:
      return po::value<unsigned>()->value_name(row.value_name);
  }
  return new po::untyped_value(true);
}

}  // namespace

std::string help_of(const OptionRow& row) {
  std::string help = row.help;
  if (!help.ends_with(':')) return help;
  const char* before = " ";
  for (const std::string& word : row.completion.words()) {
    help += before + word;
    before = " | ";
  }
  return help;
}

po::options_description table_of(const char* title, std::span<const OptionRow> rows,
                                 unsigned columns) {
  po::options_description table(title, columns);
  for (const OptionRow& row : rows) {
    table.add_options()(row.names, value_of(row), help_of(row).c_str());
  }
  return table;
}

}  // namespace frontend
