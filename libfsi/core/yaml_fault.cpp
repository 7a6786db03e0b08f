#include <yaml.h>

#include <sstream>
#include <vector>

#include "libfsi/core/arguments.hpp"

namespace fsi {
namespace {

/// The line of a text, counted from 0.
std::string line_of(const std::string& text, std::size_t number) {
  std::istringstream stream(text);
  std::string line;
  for (std::size_t i = 0; i <= number; ++i)
    if (!std::getline(stream, line)) return "";
  return line;
}

/// Where and why the parser stopped.
std::string reason(const yaml_parser_t& parser, const std::string& yaml) {
  const std::size_t line = parser.problem_mark.line, begin = parser.context_mark.line;
  std::string text = "line " + std::to_string(line + 1) + ": ";
  text += parser.problem != nullptr ? parser.problem : "not readable";
  if (parser.context != nullptr)
    text +=
        std::string(", ") + parser.context + " that begins in line " + std::to_string(begin + 1);
  if (line_of(yaml, line).find('\t') != std::string::npos)
    text += "; the line holds a tab, and YAML indents by blanks alone";
  return text;
}

/// What begins with an event that PETSc drops without a word or does not take: a block without keys
/// within another, or a list of blocks. around: the events of the blocks and lists about it; last:
/// the event before. "" for other events.
std::string no_options(const yaml_event_t& event, yaml_event_type_t last,
                       const std::vector<yaml_event_type_t>& around) {
  std::string what;
  if (event.type == YAML_MAPPING_END_EVENT && last == YAML_MAPPING_START_EVENT && around.size() > 1)
    what = "a block without keys";
  if (event.type == YAML_MAPPING_START_EVENT && !around.empty() &&
      around.back() == YAML_SEQUENCE_START_EVENT)
    what = "a list of blocks; give each block a name of its own, as in {left: {...}, right: {...}}";
  if (what.empty()) return "";
  return "line " + std::to_string(event.start_mark.line + 1) + ": " + what;
}

/// Keeps the starts of the blocks and lists that are open after an event.
void follow(std::vector<yaml_event_type_t>& around, yaml_event_type_t event) {
  if (event == YAML_MAPPING_START_EVENT || event == YAML_SEQUENCE_START_EVENT)
    around.push_back(event);
  if (event == YAML_MAPPING_END_EVENT || event == YAML_SEQUENCE_END_EVENT) around.pop_back();
}

}  // namespace

std::string yaml_fault(const std::string& yaml) {
  yaml_parser_t parser;
  if (yaml_parser_initialize(&parser) == 0) return "";
  yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(yaml.data()),
                               yaml.size());
  std::string fault;
  std::vector<yaml_event_type_t> around;
  yaml_event_type_t last = YAML_NO_EVENT;
  for (bool going = true; going;) {
    yaml_event_t event;
    if (yaml_parser_parse(&parser, &event) == 0) {
      fault = reason(parser, yaml);
      break;
    }
    fault = no_options(event, last, around);
    follow(around, event.type);
    last = event.type;
    going = event.type != YAML_STREAM_END_EVENT && fault.empty();
    yaml_event_delete(&event);
  }
  yaml_parser_delete(&parser);
  return fault;
}

}  // namespace fsi
