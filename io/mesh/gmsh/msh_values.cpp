// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads values of elements in .msh files from the sections ElementData.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/mesh/field_names.h"
#include "io/mesh/gmsh/msh_sections.h"

namespace mw::io {
namespace {

/// Finds the rows of tets by the numbers of their elements.
class TetsByNumber {
 public:
  explicit TetsByNumber(const std::vector<std::uint64_t>& numbers)
      : numbers_(numbers), rows_(numbers.size()) {
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
    std::stable_sort(rows_.begin(), rows_.end(),
                     [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  }

  [[nodiscard]] std::optional<std::size_t> find(std::uint64_t number) const {
    const auto at = std::lower_bound(
        rows_.begin(), rows_.end(), number,
        [&](std::size_t row, std::uint64_t wanted) { return numbers_[row] < wanted; });
    if (at == rows_.end() || numbers_[*at] != number) return std::nullopt;
    return *at;
  }

 private:
  const std::vector<std::uint64_t>& numbers_;
  std::vector<std::size_t> rows_;
};

std::int64_t read_line_number(MshInput& in, std::string_view expected) {
  const auto number = parse_integer(in.next_line(expected));
  if (!number) in.fail(text("no ", expected));
  return *number;
}

/// The head that stands ahead of the values.
struct DataHead {
  std::string name;
  std::int64_t components = 0;
  std::uint64_t rows = 0;
};

/// Reads the head, which is lines of text in binary files too: a count and strings, a count and
/// reals, a count and integers.
DataHead read_head(MshInput& in) {
  DataHead out;
  const std::int64_t strings = read_line_number(in, "number of names");
  for (std::int64_t i = 0; i < strings; ++i) {
    std::string line(in.next_line("a name of values"));
    std::erase(line, '"');
    if (i == 0) out.name = std::move(line);
  }
  const std::int64_t reals = read_line_number(in, "number of times");
  for (std::int64_t i = 0; i < reals; ++i) static_cast<void>(in.next_line("a time"));
  const std::int64_t integers = read_line_number(in, "number of integers");
  for (std::int64_t i = 0; i < integers; ++i) {
    const std::int64_t number = read_line_number(in, "integer about values");
    if (i == 1) out.components = number;
    if (i == 2 && number < 0) in.fail(text(number, " values are announced"));
    if (i == 2) out.rows = static_cast<std::uint64_t>(number);
  }
  return out;
}

void read_data(MshInput& in, const DataHead& head, const TetsByNumber& tets, MshContent& out) {
  in.check_rows(head.rows, sizeof(std::int32_t) + sizeof(double), 2);
  TetValues column{head.name, std::vector<double>(out.numbers.size(), std::nan(""))};
  bool has_any = false;
  for (std::uint64_t i = 0; i < head.rows; ++i) {
    const auto element = static_cast<std::uint64_t>(in.integer("the number of an element"));
    const double value = in.real_or_nan("a value");
    const auto row = tets.find(element);
    if (!row) continue;
    column.numbers[*row] = value;
    has_any = true;
  }
  in.end_section("ElementData");
  if (has_any && out.values.size() < kMostValues) out.values.push_back(std::move(column));
}

}  // namespace

void read_msh_values(MshInput& in, MshContent& out) {
  std::optional<TetsByNumber> tets;
  for (std::string section = in.next_section(); !section.empty(); section = in.next_section()) {
    if (section != "ElementData") {
      // A section that is not read may be cut, since nothing of the mesh is lost with it.
      if (!in.find_end(section)) return;
      continue;
    }
    const DataHead head = read_head(in);
    if (head.components != 1) {
      in.skip_section(section);
      continue;
    }
    if (!tets) tets.emplace(out.numbers);
    read_data(in, head, *tets, out);
  }
}

}  // namespace mw::io
