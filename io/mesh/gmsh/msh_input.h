// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the sections and numbers of a .msh file, from text or from bytes.
#pragma once

#include "io/file/byte_order.h"
#include "io/file/source/byte_cursor.h"

namespace mw::io {

/// ERRORS (all members): mw::Error(kInput) with file, line or byte, and what was expected.
class MshInput {
 public:
  explicit MshInput(const ByteSource& source) : cursor_(source) {}

  [[nodiscard]] bool ascii() const { return ascii_; }
  [[nodiscard]] const std::string& name() const { return cursor_.source().name(); }
  /// Makes the numbers that follow be read as bytes.
  void set_binary(ByteOrder order);
  /// Returns the next line that is not blank, without blanks at its ends.  It is valid until the
  /// next call of any member.
  [[nodiscard]] std::string_view next_line(std::string_view expected);
  /// Returns the name of the section that begins here, as "Nodes"; empty at the end of the file.
  [[nodiscard]] std::string next_section();
  /// Reads the line "$End<section>", which must come here.
  void end_section(std::string_view section);
  /// Skips all up to and including that line.
  void skip_section(std::string_view section);
  /// Skips as much, and returns whether that line came before the end of the file.
  [[nodiscard]] bool find_end(std::string_view section);

  /// Reads an integer, of 32 bits in binary.
  [[nodiscard]] std::int64_t integer(std::string_view expected);
  /// Reads a number that is not negative, of 64 bits in binary.
  [[nodiscard]] std::uint64_t count(std::string_view expected);
  /// Reads a finite number.
  [[nodiscard]] double real(std::string_view expected);
  /// Reads a number, finite or not.
  [[nodiscard]] double real_or_nan(std::string_view expected);
  /// Skips reals that do not matter, finite or not.
  void skip_reals(std::int64_t how_many);
  /// Fails unless the rest of the file can hold these rows, of at least `bytes` bytes each in
  /// binary or `numbers` numbers in text, so that a damaged count cannot ask for all memory.
  void check_rows(std::uint64_t rows, std::uint64_t bytes, std::uint64_t numbers) const;

  [[noreturn]] void fail(std::string_view reason) const;

 private:
  [[nodiscard]] std::string_view word();
  [[noreturn]] void fail_word(std::string_view expected) const;
  template <class T>
  [[nodiscard]] T from_bytes(std::string_view expected);

  ByteCursor cursor_;
  std::string text_;        ///< the last word or line
  std::uint64_t line_ = 1;  ///< line where that began
  bool ascii_ = true;
  ByteOrder order_ = kHostOrder;
};

}  // namespace mw::io
