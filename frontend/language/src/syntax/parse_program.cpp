#include "syntax/parse_program.hpp"

#include <exception>

#include "base/with_deep_stack.hpp"
#include "syntax/program_reader.hpp"

namespace language {

namespace {

ParseOutcome parse_here(Program& program, Messages& messages, const std::string& path,
                        const ParseOptions& options) {
  const auto say = [&](std::string line) { messages.say(MessageGroup::kPlain, std::move(line)); };
  ProgramReader reader(program, messages, options);
  if (!reader.read_main(path)) {
    say("Can't open input file '" + path + "'!");
    say("");
    return ParseOutcome::kUnreadable;
  }
  program.is_parsed = reader.parse_main();
  if (!program.is_parsed) {
    say("Can't parse file '" + (path == "-" ? "<stdin>" : path) + "'!");
    say("");
    return ParseOutcome::kNotParsed;
  }
  reader.parse_used();
  return ParseOutcome::kParsed;
}

}  // namespace

ParseOutcome parse_program(Program& program, Messages& messages, const std::string& path,
                           const ParseOptions& options) {
  ParseOutcome outcome{};
  with_deep_stack([&] { outcome = parse_here(program, messages, path, options); });
  return outcome;
}

}  // namespace language
