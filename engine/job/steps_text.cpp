// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A word for the kind of step, then its numbers.
#include "engine/job/steps_text.h"

#include <sstream>

#include "engine/store/journal/work_file.h"

namespace mw::engine {
namespace {

std::string numbers(const std::vector<RawLabel>& labels) {
  std::string out;
  for (const RawLabel label : labels) out += " " + std::to_string(label);
  return out;
}

/// Reads the labels up to the end of the line.
std::vector<RawLabel> labels_of(std::istream& line) {
  std::vector<RawLabel> out;
  for (RawLabel label = 0; line >> label;) out.push_back(label);
  return out;
}

/// Reads a line of text_of().  Returns false if it is none.
bool read_step(std::istream& line, io::InputSteps& steps) {
  std::string kind;
  line >> kind;
  if (kind == "merge") {
    io::MergeRule rule;
    if (!(line >> rule.to_is_negative >> rule.to)) return false;
    rule.from = labels_of(line);
    steps.merge.push_back(std::move(rule));
  } else if (kind == "specks") {
    io::SpeckRule& rule = steps.specks.emplace();
    return !(line >> rule.min >> rule.diagonal).fail();
  } else if (kind == "weld") {
    steps.weld = labels_of(line);
  } else {
    return false;
  }
  return line.eof();
}

}  // namespace

std::string text_of(const io::InputSteps& steps) {
  std::ostringstream out;
  for (const io::MergeRule& rule : steps.merge) {
    out << "merge " << rule.to_is_negative << " " << rule.to << numbers(rule.from) << "\n";
  }
  if (steps.specks) out << "specks " << steps.specks->min << " " << steps.specks->diagonal << "\n";
  if (!steps.weld.empty()) out << "weld" << numbers(steps.weld) << "\n";
  return out.str();
}

io::InputSteps steps_of(const std::string& text) {
  io::InputSteps out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    if (!read_step(words, out)) throw DamagedWork("steps of the labels", "unknown: " + line);
  }
  return out;
}

}  // namespace mw::engine
