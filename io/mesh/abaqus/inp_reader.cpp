// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the mesh of an Abaqus input file.
#include "io/mesh/abaqus/inp_reader.h"

#include <algorithm>

#include "io/file/errors.h"
#include "io/file/open_bytes.h"
#include "io/file/text_numbers.h"
#include "io/mesh/abaqus/element_sets.h"
#include "io/mesh/abaqus/inp_comments.h"
#include "io/mesh/abaqus/inp_lines.h"
#include "io/mesh/abaqus/set_labels.h"
#include "io/mesh/tagged_mesh.h"

namespace mw::io {
namespace {

/// Nodes of a tet type, 0 of all other types: C3D4, C3D10M, DC3D4, AC3D10, ..
std::size_t tet_nodes(const std::string& type) {
  const std::string name = in_capitals(type);
  const std::size_t at = name.find("C3D");
  if (at == std::string::npos || at > 1) return 0;
  const std::size_t digits = at + 3;
  const std::string number =
      name.substr(digits, name.find_first_not_of("0123456789", digits) - digits);
  return number == "4" ? 4 : number == "10" ? 10 : 0;
}

/// One pass over the lines.
class InpReader {
 public:
  explicit InpReader(const ByteSource& source)
      : lines_(source, [this](std::string_view line) { take_comment(line); }),
        mesh_(source.name()) {}

  MeshData read();

 private:
  enum class Section { kOther, kNodes, kTets, kSet };

  void take_comment(std::string_view line);
  void take_keyword(const InpLine& line);
  void refuse_unlisted(const InpLine& line) const;
  void begin_elements(const InpLine& line);
  void begin_set(const InpLine& line);
  void take_data(const InpLine& line);
  void take_node(const std::vector<std::string>& items);
  void take_tet(const std::vector<std::string>& items);
  void take_members(const std::vector<std::string>& items);
  void check_end() const;

  InpLines lines_;
  TaggedMesh mesh_;
  ElementSets sets_;
  std::vector<LabelName> names_;
  Section section_ = Section::kOther;
  std::size_t nodes_ = 0;               ///< of a tet of this section
  std::uint64_t set_ = 0;               ///< of this section
  bool has_set_ = false;                ///< the elements of this section
  bool generate_ = false;               ///< this section is of ranges
  std::vector<std::uint64_t> numbers_;  ///< of a tet that goes on in the next line
  bool ours_ = false;
  bool ended_ = false;
};

MeshData InpReader::read() {
  InpLine line;
  while (lines_.next(line)) line.keyword.empty() ? take_data(line) : take_keyword(line);
  check_end();
  sets_.close(mesh_.marks());
  const SetLabels labels = labels_of_sets(sets_.keep_used(mesh_.marks()));
  for (RawLabel& mark : mesh_.marks()) mark = labels.labels[mark];
  MeshData out = mesh_.finish();
  out.labels_signed = labels.labels_signed;
  out.names = labels.names.merged_with(LabelNames(std::move(names_)));
  return out;
}

void InpReader::take_comment(std::string_view line) {
  if (line == kInpBegins) ours_ = true;
  if (line == kInpEnds) ended_ = true;
  if (auto row = parse_inp_comment(line)) names_.push_back(std::move(*row));
}

void InpReader::take_keyword(const InpLine& line) {
  if (!numbers_.empty()) lines_.fail("the element before lacks nodes");
  refuse_unlisted(line);
  section_ = Section::kOther;
  if (line.keyword == "NODE") section_ = Section::kNodes;
  if (line.keyword == "ELEMENT") begin_elements(line);
  if (line.keyword == "ELSET") begin_set(line);
}

void InpReader::refuse_unlisted(const InpLine& line) const {
  constexpr std::array<std::string_view, 8> kMakers{"INCLUDE", "NGEN",  "NFILL",  "NCOPY",
                                                    "NMAP",    "ELGEN", "ELCOPY", "SYSTEM"};
  if (std::find(kMakers.begin(), kMakers.end(), line.keyword) != kMakers.end()) {
    lines_.fail(text("*", line.keyword, " is not read"));
  }
  const bool of_mesh =
      line.keyword == "NODE" || line.keyword == "ELEMENT" || line.keyword == "ELSET";
  if (of_mesh && line.values.contains("INPUT")) lines_.fail("INPUT= names another file");
  const auto system = line.values.find("SYSTEM");
  if (line.keyword == "NODE" && system != line.values.end() && in_capitals(system->second) != "R") {
    lines_.fail("coordinates of another system are not read");
  }
}

void InpReader::begin_elements(const InpLine& line) {
  const auto type = line.values.find("TYPE");
  if (type == line.values.end()) lines_.fail("*ELEMENT without TYPE");
  nodes_ = tet_nodes(type->second);
  if (nodes_ == 0) return;
  section_ = Section::kTets;
  const auto set = line.values.find("ELSET");
  has_set_ = set != line.values.end();
  set_ = sets_.number_of(has_set_ ? set->second : "");
}

void InpReader::begin_set(const InpLine& line) {
  const auto name = line.values.find("ELSET");
  // Abaqus makes internal ones for surfaces.
  if (name == line.values.end() || line.values.contains("INTERNAL")) return;
  section_ = Section::kSet;
  set_ = sets_.number_of(name->second);
  generate_ = line.values.contains("GENERATE");
}

void InpReader::take_data(const InpLine& line) {
  if (section_ == Section::kNodes) take_node(line.items);
  if (section_ == Section::kTets) take_tet(line.items);
  if (section_ == Section::kSet) take_members(line.items);
}

/// Coordinates that are left out are 0.
void InpReader::take_node(const std::vector<std::string>& items) {
  Position position{};
  for (std::size_t k = 0; k < 3 && k + 1 < items.size(); ++k) {
    if (!items[k + 1].empty()) position[k] = lines_.real(items[k + 1]);
  }
  mesh_.add_node(lines_.integer(items[0], "the number of a node"), position);
}

void InpReader::take_tet(const std::vector<std::string>& items) {
  for (const std::string& item : items) {
    if (item.empty() && &item == &items.back()) break;  // the comma of a line that goes on
    numbers_.push_back(lines_.integer(item, "the number of an element or node"));
  }
  if (numbers_.size() > 1 + nodes_) lines_.fail("too many numbers of an element");
  if (numbers_.size() <= nodes_) return;
  if (!has_set_) sets_.add_open(numbers_[0], mesh_.tet_count());
  mesh_.add_tet(std::span(numbers_).subspan(1), set_);
  numbers_.clear();
}

/// Names of other sets, too, may be members; their elements are in those already.
void InpReader::take_members(const std::vector<std::string>& items) {
  if (generate_) {
    if (items.size() < 2) lines_.fail("no range of elements");
    const std::string step = items.size() < 3 || items[2].empty() ? "1" : items[2];
    const ElementRange range{lines_.integer(items[0], "the first element"),
                             lines_.integer(items[1], "the last element"),
                             lines_.integer(step, "a step")};
    if (range.step == 0) lines_.fail("a step of 0");
    sets_.add_range(set_, range);
    return;
  }
  for (const std::string& item : items) {
    const auto element = parse_integer(item);
    if (!element || *element < 0) continue;
    const auto number = static_cast<std::uint64_t>(*element);
    sets_.add_range(set_, {number, number, 1});
  }
}

void InpReader::check_end() const {
  if (!numbers_.empty()) lines_.fail("truncated: the last element lacks nodes");
  if (ours_ && !ended_) lines_.fail("truncated: the file ends without END OF MESH");
  if (mesh_.tet_count() == 0 && !ours_) lines_.fail("no tetrahedra (C3D4, C3D10) in the file");
}

}  // namespace

MeshData read_inp(const std::filesystem::path& path) {
  return InpReader(*open_bytes(path)).read();
}

}  // namespace mw::io
