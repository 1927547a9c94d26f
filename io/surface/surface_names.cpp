// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the parts of a surface are called in files whose names are single words, and in the names of
// files.
#include "io/surface/surface_names.h"

#include <algorithm>
#include <set>

#include "io/mesh/grouped/group_names.h"

namespace mw::io {
namespace {

bool is_control(char c) {
  const auto code = static_cast<unsigned char>(c);
  constexpr unsigned char kDelete = 127;
  return code < ' ' || code == kDelete;
}

bool is_any_of(char c, std::string_view characters) {
  return characters.find(c) != characters.npos;
}

}  // namespace

std::string one_word(std::string_view name) {
  std::string word(name);
  for (char& c : word) {
    if (is_control(c) || is_any_of(c, " \"#$%&'*/:;<=>?\\`|")) c = '_';
  }
  return word;
}

std::string file_word(std::string_view name) {
  std::string word(name);
  for (char& c : word) {
    if (is_control(c) || is_any_of(c, "\"*/:<>?\\|")) c = '_';
  }
  if (word.starts_with('.')) word.front() = '_';
  if (word.ends_with('.') || word.ends_with(' ')) word.back() = '_';
  return word;
}

SurfaceNames::SurfaceNames(const SurfaceHeader& header) : ranks_(ranks_of(header)) {
  std::set<std::string> taken;
  const LabelTable& table = header.labels->table;
  for (const Label rank : ranks_) {
    std::string word = one_word(header.labels->titles[rank]);
    while (!taken.insert(word).second) {
      word += "_" + label_text(table.raw(rank), table.is_signed());
    }
    words_.push_back(std::move(word));
  }
}

const std::string& SurfaceNames::label(Label rank) const {
  const auto found = std::lower_bound(ranks_.begin(), ranks_.end(), rank);
  return words_[static_cast<std::size_t>(found - ranks_.begin())];
}

std::string SurfaceNames::run(const SurfaceRun& run) const {
  const bool is_interface = run.side == Side::kInterface;
  return label(run.inside) + "|" +
         (is_interface ? label(run.outside) : std::string("|") + side_name(run.side));
}

std::vector<std::string> shell_names(const SurfaceHeader& header) {
  const SurfaceNames names(header);
  std::vector<std::string> out;
  for (const SurfaceShell& shell : header.shells) {
    if (shell.label) out.push_back(names.label(*shell.label));
  }
  return out;
}

}  // namespace mw::io
