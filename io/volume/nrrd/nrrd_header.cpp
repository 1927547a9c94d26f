// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text header of an NRRD volume.
#include "io/volume/nrrd/open_nrrd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "io/file/errors.h"
#include "io/file/read_number.h"
#include "io/file/text_numbers.h"
#include "io/volume/checks.h"

namespace mw::io {
namespace {

using FieldMap = std::map<std::string, std::string, std::less<>>;

std::string_view trim(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

/// Makes one key of "space directions" and "spacedirections", which are the same field.
std::string field_key(std::string_view name) {
  std::string key = lower_case(trim(name));
  std::erase(key, ' ');
  return key;
}

/// The format writes line ends and backslashes in values as \n and \\.
std::string unescaped(std::string_view value) {
  std::string out;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const bool is_escape = value[i] == '\\' && i + 1 < value.size();
    if (is_escape) ++i;
    out.push_back(is_escape && value[i] == 'n' ? '\n' : value[i]);
  }
  return out;
}

/// Splits the header into fields, and keys with their values; sets bytes to where it ends.
FieldMap split_fields(std::string_view head, std::size_t& bytes, NrrdKeys& keys,
                      std::string_view file) {
  FieldMap fields;
  std::size_t at = head.find('\n');
  at = at == std::string_view::npos ? head.size() : at + 1;
  while (at < head.size()) {
    const std::size_t end = head.find('\n', at);
    const std::string_view line = trim(head.substr(at, end - at));
    at = end == std::string_view::npos ? head.size() : end + 1;
    if (line.empty()) break;
    const std::size_t colon = line.find(':');
    if (line[0] == '#' || colon == std::string_view::npos) continue;
    if (line.substr(colon).starts_with(":=")) {
      keys[std::string(line.substr(0, colon))] = unescaped(line.substr(colon + 2));
      continue;
    }
    const std::string key = field_key(line.substr(0, colon));
    fields[key == "centerings" ? "centers" : key] = std::string(trim(line.substr(colon + 1)));
    if (key == "datafile" && is_nrrd_list(fields[key])) break;  // all that follows is the list
  }
  if (at >= kMaxNrrdHeaderBytes) fail_input(file, "NRRD header", "its end was not found");
  bytes = at;
  return fields;
}

const std::string& required(const FieldMap& fields, std::string_view key, std::string_view file) {
  const auto found = fields.find(key);
  if (found == fields.end()) {
    fail_input(file, text("NRRD field '", key, "'"), "missing", "add it to the header");
  }
  return found->second;
}

VoxelType parse_type(const std::string& value, std::string_view file) {
  static const std::map<std::string, VoxelType, std::less<>> types{
      {"float", VoxelType::kF32},
      {"double", VoxelType::kF64},
      {"signed char", VoxelType::kI8},
      {"int8", VoxelType::kI8},
      {"int8_t", VoxelType::kI8},
      {"uchar", VoxelType::kU8},
      {"unsigned char", VoxelType::kU8},
      {"uint8", VoxelType::kU8},
      {"uint8_t", VoxelType::kU8},
      {"short", VoxelType::kI16},
      {"short int", VoxelType::kI16},
      {"signed short", VoxelType::kI16},
      {"signed short int", VoxelType::kI16},
      {"int16", VoxelType::kI16},
      {"int16_t", VoxelType::kI16},
      {"ushort", VoxelType::kU16},
      {"unsigned short", VoxelType::kU16},
      {"unsigned short int", VoxelType::kU16},
      {"uint16", VoxelType::kU16},
      {"uint16_t", VoxelType::kU16},
      {"int", VoxelType::kI32},
      {"signed int", VoxelType::kI32},
      {"int32", VoxelType::kI32},
      {"int32_t", VoxelType::kI32},
      {"uint", VoxelType::kU32},
      {"unsigned int", VoxelType::kU32},
      {"uint32", VoxelType::kU32},
      {"uint32_t", VoxelType::kU32},
      {"longlong", VoxelType::kI64},
      {"long long", VoxelType::kI64},
      {"long long int", VoxelType::kI64},
      {"signed long long", VoxelType::kI64},
      {"signed long long int", VoxelType::kI64},
      {"int64", VoxelType::kI64},
      {"int64_t", VoxelType::kI64},
      {"ulonglong", VoxelType::kU64},
      {"unsigned long long", VoxelType::kU64},
      {"unsigned long long int", VoxelType::kU64},
      {"uint64", VoxelType::kU64},
      {"uint64_t", VoxelType::kU64}};
  const auto found = types.find(lower_case(value));
  if (found != types.end()) return found->second;
  fail_input(file, text("NRRD field 'type' = ", value),
             "unsupported; labels must be integers of 8 to 64 bits", "convert the voxels");
}

/// Returns the numbers that stand between blanks, commas and parentheses.
template <class T>
std::vector<T> parse_numbers(const std::string& value, std::string_view field,
                             std::string_view file) {
  constexpr std::string_view kSeparators = " \t,()";
  std::vector<T> numbers;
  for (std::size_t at = value.find_first_not_of(kSeparators); at != std::string::npos;) {
    const std::size_t end = std::min(value.find_first_of(kSeparators, at), value.size());
    T number{};
    if (!read_number(std::string_view(value).substr(at, end - at).substr(value[at] == '+'),
                     number)) {
      fail_input(file, text("NRRD field '", field, "'"), text("no valid numbers: ", value));
    }
    numbers.push_back(number);
    at = value.find_first_not_of(kSeparators, end);
  }
  return numbers;
}

/// Returns for each axis whether its kind is one of space; nothing when the file does not say.
std::vector<bool> is_domain(const FieldMap& fields) {
  std::vector<bool> out;
  const auto found = fields.find("kinds");
  if (found == fields.end()) return out;
  std::istringstream kinds(lower_case(found->second));
  for (std::string kind; kinds >> kind;) {
    out.push_back(kind == "domain" || kind == "space" || kind == "none" || kind == "???");
  }
  return out;
}

/// Returns for each axis whether it lies in space: `space directions` has a vector for it rather
/// than "none", else its kind says so.
std::vector<bool> is_spatial(const FieldMap& fields) {
  const auto found = fields.find("spacedirections");
  if (found == fields.end()) return is_domain(fields);
  std::vector<bool> out;
  const std::string& value = found->second;
  for (std::size_t at = value.find_first_of("(n"); at != std::string::npos;) {
    const bool is_vector = value[at] == '(';
    out.push_back(is_vector);
    const std::size_t end = is_vector ? value.find(')', at) : at + 4;
    at = end >= value.size() ? std::string::npos : value.find_first_of("(n", end);
  }
  return out;
}

/// Returns the sizes of the axes in space.  One other axis may have layers; all further ones must
/// have a single element, and are left out.
std::vector<std::int64_t> spatial_sizes(const FieldMap& fields, NrrdHeader& header,
                                        std::string_view file) {
  auto sizes = parse_numbers<std::int64_t>(required(fields, "sizes", file), "sizes", file);
  constexpr std::size_t kAxesWithLayers = 4;
  const std::vector<bool> spatial = is_spatial(fields);
  for (std::size_t i = spatial.size(); i-- > 0;) {
    if (spatial[i] || spatial.size() != sizes.size()) continue;
    const bool is_end = i == 0 || i + 1 == sizes.size();
    const bool may_be_layers = !header.segments.empty() || spatial.size() == kAxesWithLayers;
    if (sizes[i] > 1 && is_end && header.layers == 1 && may_be_layers) {
      header.layers = sizes[i];
      header.layers_first = i == 0;
    } else if (sizes[i] != 1) {
      fail_input(
          file, "NRRD fields 'dimension', 'space directions' and 'kinds'",
          text("of ", sizes.size(), " axes one that is none of space has ", sizes[i], " elements"),
          "pick one channel");
    }
    sizes.erase(sizes.begin() + static_cast<std::ptrdiff_t>(i));
  }
  while (sizes.size() > 3 && sizes.back() == 1) sizes.pop_back();
  while (sizes.size() > 3 && sizes.front() == 1) sizes.erase(sizes.begin());
  return sizes;
}

/// The most axes of a NRRD file, by the format's definition.
constexpr std::size_t kMaxNrrdAxes = 16;

std::vector<std::int64_t> numbers_of_sizes(const FieldMap& fields, std::string_view file) {
  return parse_numbers<std::int64_t>(required(fields, "sizes", file), "sizes", file);
}

/// Returns the shape, and finds layers.
Index3 parse_sizes(const FieldMap& fields, NrrdHeader& header, std::string_view file) {
  const std::vector<std::int64_t> all = numbers_of_sizes(fields, file);
  const auto rank =
      parse_numbers<std::int64_t>(required(fields, "dimension", file), "dimension", file);
  if (all.size() > kMaxNrrdAxes) {
    fail_input(file, "NRRD field 'sizes'",
               text("the volume has ", all.size(), " axes, 3 are needed"), "pick one channel");
  }
  const std::vector<std::int64_t> sizes = spatial_sizes(fields, header, file);
  if (sizes.size() != 3 || rank.size() != 1 || rank[0] != static_cast<std::int64_t>(all.size())) {
    fail_input(file, "NRRD fields 'dimension' and 'sizes'",
               text("the volume has ", all.size(), " axes, 3 are needed"), "pick one channel");
  }
  return checked_shape(file, "NRRD field 'sizes'", {sizes[0], sizes[1], sizes[2]});
}

void check_layers(const NrrdHeader& header, std::string_view file) {
  for (const Segment& segment : header.segments) {
    if (segment.layer < header.layers) continue;
    fail_input(file, "NRRD keys 'SegmentN_Layer'",
               text("segment '", segment.name.name, "' is in layer ", segment.layer, " of ",
                    header.layers),
               "save the segmentation again");
  }
}

ByteOrder parse_endian(const FieldMap& fields, VoxelType type, std::string_view file) {
  if (byte_size(type) == 1) return ByteOrder::kLittle;
  const std::string value = lower_case(required(fields, "endian", file));
  if (value == "big") return ByteOrder::kBig;
  if (value == "little") return ByteOrder::kLittle;
  fail_input(file, "NRRD field 'endian'", text(value, " is neither little nor big"));
}

NrrdEncoding parse_encoding(const FieldMap& fields, std::string_view file) {
  const std::string value = lower_case(required(fields, "encoding", file));
  if (value == "gzip" || value == "gz") return NrrdEncoding::kGzip;
  if (value == "raw") return NrrdEncoding::kRaw;
  if (value == "ascii" || value == "text" || value == "txt") return NrrdEncoding::kText;
  fail_input(file, text("NRRD field 'encoding' = ", value), "unsupported",
             "save as raw, gzip or text");
}

void parse_skips(const FieldMap& fields, NrrdHeader& header, std::string_view file) {
  for (const char* key : {"lineskip", "byteskip"}) {
    const auto found = fields.find(key);
    if (found == fields.end()) continue;
    const auto skip = parse_numbers<std::int64_t>(found->second, key, file);
    const bool is_line = found->first == "lineskip";
    const std::int64_t min = is_line || header.encoding != NrrdEncoding::kRaw ? 0 : -1;
    if (skip.size() != 1 || skip[0] < min || (is_line && skip[0] != 0)) {
      fail_input(file, text("NRRD field '", is_line ? "line skip" : "byte skip", "'"),
                 text(found->second, " is not supported"), "save the file without skips");
    }
    if (!is_line) header.byte_skip = skip[0];
  }
}

Vector3 three_numbers(const std::string& value, std::string_view field, std::string_view file) {
  const auto v = parse_numbers<double>(value, field, file);
  if (v.size() != 3) fail_input(file, text("NRRD field '", field, "'"), "not three numbers");
  return {v[0], v[1], v[2]};
}

void parse_steps(const FieldMap& fields, FileSpace& space, std::string_view file) {
  space.is_sized = fields.contains("spacedirections") || fields.contains("spacings");
  if (const auto found = fields.find("spacedirections"); found != fields.end()) {
    std::string vectors = found->second;
    // Blanks keep the length, so that a header of many "none" is gone through only once.
    for (std::size_t at = vectors.find("none"); at != std::string::npos;
         at = vectors.find("none", at)) {
      vectors.replace(at, 4, "    ");
    }
    const auto v = parse_numbers<double>(vectors, "space directions", file);
    if (v.size() != 9) fail_input(file, "NRRD field 'space directions'", "not three 3-vectors");
    space.steps = {{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}}};
  } else if (const auto spacings = fields.find("spacings"); spacings != fields.end()) {
    space.steps = steps_of(three_numbers(spacings->second, "spacings", file));
  }
}

/// Returns for each axis whether its first sample lies in the middle of a cell that begins at the
/// minimum of the axis, as Teem has it unless `centers` says "node".
std::array<bool, 3> are_cells(const FieldMap& fields) {
  std::array<bool, 3> out{true, true, true};
  const auto found = fields.find("centers");
  if (found == fields.end()) return out;
  std::istringstream words(lower_case(found->second));
  std::string word;
  for (std::size_t i = 0; i < out.size() && words >> word; ++i) out[i] = word != "node";
  return out;
}

/// Returns the numbers of a field that has one for each axis; nothing where they are not known.
std::optional<Vector3> numbers_of_axes(const FieldMap& fields, const std::string& key,
                                       std::string_view field, std::string_view file) {
  const auto found = fields.find(key);
  if (found == fields.end()) return std::nullopt;
  auto numbers = parse_numbers<double>(found->second, field, file);
  const std::vector<bool> spatial = is_spatial(fields);
  for (std::size_t i = spatial.size() == numbers.size() ? spatial.size() : 0; i-- > 0;) {
    if (!spatial[i]) numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(i));
  }
  const auto is_unknown = [](double x) { return std::isnan(x); };
  if (std::all_of(numbers.begin(), numbers.end(), is_unknown)) return std::nullopt;
  if (numbers.size() != 3) {
    fail_input(file, text("NRRD field '", field, "'"), "not three numbers");
  }
  return Vector3{numbers[0], numbers[1], numbers[2]};
}

/// Takes the size of voxels from `axis mins` and `axis maxs` where no other field has it.
void parse_axis_ends(const FieldMap& fields, Index3 shape, FileSpace& space,
                     std::string_view file) {
  if (fields.contains("spacings") || fields.contains("spacedirections")) return;
  const auto mins = numbers_of_axes(fields, "axismins", "axis mins", file);
  const auto maxs = numbers_of_axes(fields, "axismaxs", "axis maxs", file);
  if (!mins || !maxs) return;
  space.is_sized = true;
  const std::array<bool, 3> cells = are_cells(fields);
  const std::array<std::int64_t, 3> voxels{shape.x, shape.y, shape.z};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t steps = voxels[i] - (cells[i] ? 0 : 1);
    if (steps > 0) space.steps[i][i] = ((*maxs)[i] - (*mins)[i]) / static_cast<double>(steps);
  }
  space.steps_field = "NRRD fields 'axis mins' and 'axis maxs'";
}

/// Reads `axis mins`, which say where the volume begins where `space origin` does not.
void parse_axis_mins(const FieldMap& fields, FileSpace& space, std::string_view file) {
  if (space.first || fields.contains("spacedirections")) return;
  space.first = numbers_of_axes(fields, "axismins", "axis mins", file);
  if (!space.first) return;
  const std::array<bool, 3> cells = are_cells(fields);
  space.first_field = "NRRD field 'axis mins'";
  space.first_is_centre = std::none_of(cells.begin(), cells.end(), [](bool is) { return is; });
  if (space.first_is_centre) return;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!cells[i]) (*space.first)[i] -= 0.5 * space.steps[i][i];
  }
}

/// Finds the world frame.  Left-anterior-superior is no WorldFrame, and its vectors are turned to
/// RAS.
void parse_frame(const FieldMap& fields, FileSpace& space) {
  const auto found = fields.find("space");
  if (found == fields.end()) return;
  const std::string name = lower_case(found->second);
  if (name == "right-anterior-superior" || name == "ras") space.frame = WorldFrame::kRas;
  if (name == "left-posterior-superior" || name == "lps") space.frame = WorldFrame::kLps;
  if (name == "left-anterior-superior" || name == "las") {
    space.frame = WorldFrame::kRas;
    for (Vector3& step : space.steps) step[0] = 0 - step[0];
    if (space.first) (*space.first)[0] = 0 - (*space.first)[0];
  }
}

/// Returns the texts between quotes.
std::vector<std::string> quoted_texts(const std::string& value) {
  std::vector<std::string> out;
  for (std::size_t at = value.find('"'); at != std::string::npos; at = value.find('"', at)) {
    const std::size_t end = value.find('"', at + 1);
    if (end == std::string::npos) break;
    out.push_back(value.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return out;
}

/// Returns the units of the axes of space; `units` has those of all axes.
std::vector<std::string> units_of(const FieldMap& fields) {
  if (const auto found = fields.find("spaceunits"); found != fields.end()) {
    return quoted_texts(found->second);
  }
  const auto found = fields.find("units");
  if (found == fields.end()) return {};
  std::vector<std::string> out = quoted_texts(found->second);
  const std::vector<bool> spatial = is_spatial(fields);
  if (spatial.size() != out.size()) return out;
  for (std::size_t i = spatial.size(); i-- > 0;) {
    if (!spatial[i]) out.erase(out.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return out;
}

/// Finds "mm" for `"mm" "mm" "mm"`.  Where an axis has no unit, there is none.
void parse_unit(const FieldMap& fields, NrrdHeader& header) {
  const std::vector<std::string> units = units_of(fields);
  if (units.empty()) return;
  const auto is_other = [&](const std::string& unit) { return unit != units.front(); };
  if (std::none_of(units.begin(), units.end(), is_other)) {
    header.space.unit = units.front();
    return;
  }
  const auto is_named = [](const std::string& unit) { return !unit.empty(); };
  header.units_differ = std::all_of(units.begin(), units.end(), is_named);
}

FileSpace parse_space(const FieldMap& fields, Index3 shape, std::string_view file) {
  FileSpace space{.steps_field = "NRRD 'spacings' or 'space directions'",
                  .first_field = "NRRD field 'space origin'"};
  parse_steps(fields, space, file);
  if (const auto found = fields.find("spaceorigin"); found != fields.end()) {
    space.first = three_numbers(found->second, "space origin", file);
  }
  parse_axis_ends(fields, shape, space, file);
  parse_axis_mins(fields, space, file);
  parse_frame(fields, space);
  return space;
}

}  // namespace

bool has_nrrd_magic(std::span<const std::byte> head) {
  return std::string_view(reinterpret_cast<const char*>(head.data()), head.size())
      .starts_with("NRRD000");
}

NrrdHeader parse_nrrd_header(std::string_view head, std::string_view file) {
  if (!has_nrrd_magic(std::as_bytes(std::span(head)))) {
    fail_input(file, "NRRD magic", "the file does not begin with NRRD000",
               "it is damaged or of another format");
  }
  NrrdHeader header;
  NrrdKeys keys;
  const FieldMap fields = split_fields(head, header.bytes, keys, file);
  header.segments = read_segments(keys);
  header.has_segment_names = has_segment_names(keys);
  header.type = parse_type(required(fields, "type", file), file);
  header.shape = parse_sizes(fields, header, file);
  check_layers(header, file);
  header.encoding = parse_encoding(fields, file);
  // Text has no byte order, and becomes bytes with the least significant one first.
  if (header.encoding != NrrdEncoding::kText) {
    header.order = parse_endian(fields, header.type, file);
  }
  parse_skips(fields, header, file);
  if (const auto found = fields.find("datafile"); found != fields.end()) {
    header.data_files = nrrd_data_files(found->second, head.substr(header.bytes),
                                        numbers_of_sizes(fields, file), file);
  }
  header.space = parse_space(fields, header.shape, file);
  parse_unit(fields, header);
  return header;
}

}  // namespace mw::io
