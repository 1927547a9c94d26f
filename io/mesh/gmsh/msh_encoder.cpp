// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Writes the sections and numbers of a .msh file, as text or as bytes.
#include "io/mesh/gmsh/msh_encoder.h"

#include <array>
#include <charconv>

#include "io/file/byte_order.h"

namespace mw::io {

void MshEncoder::end_section(std::string_view name) {
  if (!ascii_) file_.append("\n");
  add_line("$End", name);
}

template <class T>
void MshEncoder::add(T number) {
  std::array<char, 32> bytes{};
  if (ascii_) {
    const char* end = std::to_chars(bytes.data(), bytes.data() + bytes.size(), number).ptr;
    row_.append(bytes.data(), static_cast<std::size_t>(end - bytes.data()));
    row_ += ' ';
    return;
  }
  store_little(number, reinterpret_cast<std::byte*>(bytes.data()));
  row_.append(bytes.data(), sizeof number);
}

void MshEncoder::put(std::int32_t number) {
  add(number);
}

void MshEncoder::put(std::uint64_t number) {
  add(number);
}

void MshEncoder::put(double number) {
  add(number);
}

void MshEncoder::end_row() {
  if (ascii_ && !row_.empty()) row_.back() = '\n';
  file_.append(row_);
  row_.clear();
}

}  // namespace mw::io
