#include <yaml.h>

#include <sstream>

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

}  // namespace

std::string yaml_fault(const std::string& yaml) {
  yaml_parser_t parser;
  if (yaml_parser_initialize(&parser) == 0) return "";
  yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(yaml.data()),
                               yaml.size());
  std::string fault;
  for (bool going = true; going;) {
    yaml_event_t event;
    if (yaml_parser_parse(&parser, &event) == 0) {
      fault = reason(parser, yaml);
      break;
    }
    going = event.type != YAML_STREAM_END_EVENT;
    yaml_event_delete(&event);
  }
  yaml_parser_delete(&parser);
  return fault;
}

}  // namespace fsi
