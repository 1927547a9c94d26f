// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What comments and documents say of other files: that it is there.
#include "tests/layers/citations.h"

#include <regex>

namespace mw::layers {
namespace {

/// The first group of each match.
std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> out;
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) {
    out.push_back((*i)[1]);
  }
  return out;
}

}  // namespace

std::vector<Citation> citations_of(const std::string& source) {
  static const std::regex next_line(R"(\n\s*(?:///?|#)[ \t]*)");
  static const std::regex web_address(R"(https?://\S+)");
  static const std::regex citation(R"re(([A-Za-z0-9_./-]+\.md)\b`?(?:,\s+"([^"\n]+)")?)re");
  std::vector<Citation> out;
  if (source.find(".md") == source.npos) return out;  // most; the search is slow
  const std::string lines = std::regex_replace(source, next_line, " ");
  const std::string text = std::regex_replace(lines, web_address, " ");
  for (std::sregex_iterator i(text.begin(), text.end(), citation), end; i != end; ++i) {
    out.push_back({.file = (*i)[1], .section = (*i)[2]});
  }
  return out;
}

std::vector<std::string> titles_of(const std::string& document) {
  static const std::regex title_line(R"(^#+ (.*)$)");
  std::vector<std::string> out;
  std::istringstream lines(document);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, match, title_line)) out.push_back(match[1]);
  }
  return out;
}

std::vector<std::string> paths_in(const std::string& document) {
  static const std::regex path_name(
      R"(`((?:kernels|io|engine|tests|bench|configs|\.ci|\.github)/[A-Za-z0-9_./-]*)`)");
  return all_matches(document, path_name);
}

std::vector<std::string> tests_in(const std::string& document) {
  static const std::regex test_name("`([A-Z][A-Za-z0-9]+\\.[A-Z][A-Za-z0-9]{3,})`");
  return all_matches(document, test_name);
}

}  // namespace mw::layers
