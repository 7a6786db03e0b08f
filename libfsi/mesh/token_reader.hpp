#pragma once
// A file in memory, read number by number, as text or binary.

#include <charconv>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "libfsi/core/error.hpp"

namespace fsi {

/// A cursor over the text of a file. Every failed read throws Error{input} with the place.
class Source {
 public:
  /// text: the content of the file.
  Source(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}

  /// Whether numbers are bytes from here on.
  void set_binary(bool binary) { binary_ = binary; }
  /// Whether they are.
  bool binary() const { return binary_; }
  /// The section whose end a truncated file misses.
  void set_section(std::string_view section) { section_ = section; }

  /// The next number: text, or in a binary file its bytes.
  template <class T>
  T take() {
    return binary_ ? bytes<T>() : number<T>();
  }
  /// The next number, written as text also in a binary file.
  template <class T>
  T number() {
    skip_space();
    const char* begin = text_.data() + at_;
    const char* end = text_.data() + text_.size();
    T value{};
    const auto [stop, code] = std::from_chars(begin, end, value);
    if (code != std::errc{} || (stop != end && !is_space(*stop))) {
      const std::string_view found = word();
      at_ -= found.size();
      if (found.empty()) fail_end();
      fail("expected a " + std::string(std::is_integral_v<T> ? "whole " : "") + "number, found \"" +
           std::string(found.substr(0, 40)) + "\"");
    }
    at_ = static_cast<std::size_t>(stop - text_.data());
    return value;
  }
  template <class T>
  /// The next number, as bytes.
  T bytes() {
    if (left() < sizeof(T)) fail_end();
    T value;
    std::memcpy(&value, text_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  /// The next run of characters without white space; empty at the end of the file.
  std::string_view word() {
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return std::string_view(text_).substr(begin, at_ - begin);
  }
  /// Whether the next word is `mark`; the cursor stays before it.
  bool next_is(std::string_view mark) {
    skip_space();
    return std::string_view(text_).substr(at_).starts_with(mark);
  }
  /// The text between the next two quotation marks.
  std::string quoted() {
    const std::size_t open = text_.find('"', at_);
    const std::size_t close = open == std::string::npos ? open : text_.find('"', open + 1);
    if (close == std::string::npos) fail("expected a name in quotation marks");
    at_ = close + 1;
    return text_.substr(open + 1, close - open - 1);
  }
  /// Moves behind the end of this line.
  void end_line() {
    const std::size_t end = text_.find('\n', at_);
    at_ = end == std::string::npos ? text_.size() : end + 1;
  }
  /// Moves behind the next occurrence of `mark`.
  void skip_past(const std::string& mark) {
    const std::size_t found = text_.find(mark, at_);
    if (found == std::string::npos) fail_end();
    at_ = found + mark.size();
  }
  /// The next word must be `mark`.
  void expect(std::string_view mark) {
    const std::string_view found = word();
    if (found == mark) return;
    if (found.empty()) fail_end();
    at_ -= found.size();
    fail("expected " + std::string(mark) + ", found \"" + std::string(found.substr(0, 40)) + "\"");
  }
  /// A count of items that take at least `size` bytes each: the rest of the file must hold them.
  std::size_t count(std::size_t n, std::size_t size, const char* what) {
    if (n > left() / size) {
      fail(std::to_string(n) + " " + what + " announced, but the file ends before them");
    }
    return n;
  }
  /// Characters left.
  std::size_t left() const { return text_.size() - at_; }

  /// Error{input} with file, place and `what`.
  [[noreturn]] void fail(const std::string& what) const {
    if (binary_) {
      throw Error(ErrorKind::input, file_ + ", byte " + std::to_string(at_) + ": " + what);
    }
    std::size_t line = 1;
    for (std::size_t i = 0; i < at_ && i < text_.size(); ++i) line += text_[i] == '\n' ? 1 : 0;
    throw Error(ErrorKind::input, file_ + ", line " + std::to_string(line) + ": " + what);
  }
  /// Error{input}: the file ends too early.
  [[noreturn]] void fail_end() const { fail("the file ends inside " + section_); }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  void skip_space() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }

  std::string file_, text_, section_ = "its first line";
  std::size_t at_ = 0;
  bool binary_ = false;
};

}  // namespace fsi
