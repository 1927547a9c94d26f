// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The XML of a VTK file, and its arrays as numbers or bytes.
#include "io/vtk_xml/vtk_document.h"

#include <algorithm>
#include <limits>
#include <new>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"
#include "io/vtk_xml/vtk_head.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kChunkBytes = 1 << 20;
constexpr std::uint64_t kMaxStringBytes = 64 << 20;

NumberType type_of(pugi::xml_node array, const ArrayName& name) {
  const std::string type = array.attribute("type").as_string();
  const auto parsed = parse_number_type(type);
  if (!parsed) {
    fail_input(name.file, text("array '", name.array, "'"), text("unknown type '", type, "'"));
  }
  return *parsed;
}

ArrayName name_of(pugi::xml_node array, const std::string& file) {
  return {file, array.attribute("Name").as_string("Points")};
}

void check_count(std::uint64_t found, std::uint64_t expected, const ArrayName& name) {
  if (found == expected) return;
  fail_input(name.file, text("array '", name.array, "'"),
             text("holds ", found, " numbers, the counts of the piece need ", expected),
             "the file is truncated or damaged");
}

}  // namespace

VtkDocument::VtkDocument(const ByteSource& source, VtkKind kind) : source_(source), kind_(kind) {
  VtkHead head = kind.leaves_contents ? read_outline(source) : read_head(source);
  if (head.tag) find_appended(head);
  parse(std::move(head.xml));
}

/// Takes the start tag of the appended data off the text and notes where and what they are.
void VtkDocument::find_appended(VtkHead& head) {
  constexpr std::uint64_t kMaxBlanks = 4096;
  const std::string tag = head.xml.substr(*head.tag);
  const std::uint64_t behind = head.tag_in_file + tag.size();
  std::string blanks;
  static_cast<void>(append_text(source_, behind, kMaxBlanks, blanks));
  const std::size_t mark = blanks.find('_');
  if (!tag.ends_with('>') || mark == std::string::npos) {
    fail_input(file(), "AppendedData", "no '_' in front of the data", "the file is truncated");
  }
  appended_ = true;
  appended_raw_ = tag.find("base64") == std::string::npos;
  appended_start_ = behind + mark + 1;
  head.xml.resize(*head.tag);
  head.xml += "</VTKFile>";
}

void VtkDocument::parse(std::string head) {
  const pugi::xml_parse_result result = xml_.load_buffer(head.data(), head.size());
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (!result) {
    fail_input(file(), text("XML at offset ", result.offset), result.description(),
               "the file is truncated, damaged or no VTK XML file");
  }
  const pugi::xml_node root = xml_.child("VTKFile");
  if (std::string_view(root.attribute("type").as_string()) != kind_.type) {
    fail_input(file(), "VTKFile type", text("not ", kind_.type), kind_.way_out);
  }
  const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
  encoding_.order = order == "BigEndian" ? ByteOrder::kBig : ByteOrder::kLittle;
  const std::string_view word = root.attribute("header_type").as_string("UInt32");
  encoding_.header_bytes = word == "UInt64" ? 8 : 4;
  const std::string_view compressor = root.attribute("compressor").as_string();
  if (compressor == "vtkZLibDataCompressor") encoding_.packing = VtkPacking::kZlib;
  if (compressor == "vtkLZ4DataCompressor") encoding_.packing = VtkPacking::kLz4;
  if (compressor == "vtkLZMADataCompressor") encoding_.packing = VtkPacking::kXz;
  if (!compressor.empty() && encoding_.packing == VtkPacking::kNone) {
    fail_input(file(), "compressor", text(compressor, " is not supported"),
               "save uncompressed, or with zlib, LZ4 or LZMA");
  }
}

pugi::xml_node VtkDocument::grid() const {
  return xml_.child("VTKFile").child(kind_.type);
}

std::uint64_t VtkDocument::number(pugi::xml_node node, const char* attribute,
                                  std::optional<std::uint64_t> fallback) const {
  const pugi::xml_attribute found = node.attribute(attribute);
  if (!found && fallback) return *fallback;
  const std::string_view digits = trimmed(found.as_string());
  if (const auto value = parse_count(digits)) return *value;
  fail_input(file(), text(node.name(), " ", attribute),
             found ? text("'", digits.substr(0, 40), "' is no whole number") : "missing",
             "the file is damaged");
}

/// Reads the appended data, once, up to the next tag; positions in it are the arrays' offsets.
std::string_view VtkDocument::appended_text() {
  if (appended_text_.empty()) {
    std::size_t end = std::string::npos;
    while (end == std::string::npos) {
      const std::size_t before = appended_text_.size();
      if (before > kMaxVtkTextBytes) fail_too_much_text(file(), "AppendedData");
      if (!append_text(source_, appended_start_, kChunkBytes, appended_text_)) break;
      end = appended_text_.find('<', before);
    }
    appended_text_.resize(std::min(end, appended_text_.size()));
  }
  return appended_text_;
}

/// Returns where the data of an array begin in the file.
std::uint64_t VtkDocument::appended_place(pugi::xml_node array, const ArrayName& name) const {
  const std::string_view format = array.attribute("format").as_string("ascii");
  const std::uint64_t offset = number(array, "offset", 0);
  const std::uint64_t position = saturating_sum(appended_start_, offset);
  if (format != "appended" || !appended_) {
    fail_input(name.file, text("array '", name.array, "'"),
               text("format '", format, "' with no appended data"));
  }
  if (source_.size_within(position) < position) {
    fail_input(name.file, text("array '", name.array, "'"),
               text("truncated: the file ends before its data, at byte ", position),
               "get a whole copy");
  }
  return position;
}

VtkContent VtkDocument::content_of(pugi::xml_node array) const {
  using Form = VtkContent::Form;
  const std::string_view format = array.attribute("format").as_string("ascii");
  if (format != "ascii" && format != "binary") {
    return {.form = appended_raw_ ? Form::kRaw : Form::kBase64,
            .begin = appended_place(array, name_of(array, file())),
            .end = std::numeric_limits<std::uint64_t>::max()};
  }
  const auto words = words_of(array.text().get());
  VtkContent out{.form = format == "ascii" ? Form::kText : Form::kBase64};
  if (words.size() != 2) return out;  // an array without a content
  out.begin = parse_count(words[0]).value_or(0);
  out.end = parse_count(words[1]).value_or(0);
  return out;
}

std::unique_ptr<ByteStream> VtkDocument::stream_of(pugi::xml_node array, const ArrayName& name) {
  if (std::string_view(array.attribute("format").as_string("ascii")) == "binary") {
    return std::make_unique<Base64Stream>(array.text().get(), name.file);
  }
  const std::uint64_t position = appended_place(array, name);
  if (appended_raw_) return std::make_unique<SourceStream>(source_, position);
  const std::string_view all = appended_text();
  const std::uint64_t offset = position - appended_start_;
  return std::make_unique<Base64Stream>(all.substr(std::min<std::size_t>(offset, all.size())),
                                        name.file);
}

std::vector<std::byte> VtkDocument::bytes_of(pugi::xml_node array, NumberType type,
                                             std::uint64_t count, const ArrayName& name) {
  const std::unique_ptr<ByteStream> stream = stream_of(array, name);
  return read_payload(*stream, encoding_, count * static_cast<std::uint64_t>(type.bytes), name);
}

std::vector<std::uint64_t> VtkDocument::integers(pugi::xml_node array, std::uint64_t count) {
  const ArrayName name = name_of(array, file());
  const NumberType type = type_of(array, name);
  if (type.is_float) {
    fail_input(name.file, text("array '", name.array, "'"), "floating point, integers are needed");
  }
  if (std::string_view(array.attribute("format").as_string("ascii")) != "ascii") {
    return integers_of_bytes(bytes_of(array, type, count, name), type, encoding_.order);
  }
  auto numbers = integers_of_text(array.text().get(), name);
  check_count(numbers.size(), count, name);
  return numbers;
}

/// Returns the characters of an array of strings, which are numbers in ascii format.
std::string VtkDocument::characters(pugi::xml_node array, const ArrayName& name) {
  std::string out;
  if (std::string_view(array.attribute("format").as_string("ascii")) == "ascii") {
    for (const std::uint64_t number : integers_of_text(array.text().get(), name)) {
      out.push_back(static_cast<char>(number));
    }
    return out;
  }
  const std::uint64_t count = announced_bytes(*stream_of(array, name), encoding_, name);
  if (count > kMaxStringBytes) {
    fail_input(name.file, text("array '", name.array, "'"), text(count, " bytes are not credible"),
               "the file is damaged");
  }
  for (const std::byte byte : bytes_of(array, NumberType{1, false, false}, count, name)) {
    out.push_back(static_cast<char>(byte));
  }
  return out;
}

std::vector<std::string> VtkDocument::strings(pugi::xml_node array) {
  const ArrayName name = name_of(array, file());
  const std::string all = characters(array, name);
  std::vector<std::string> out;
  std::size_t at = 0;
  for (std::size_t end = all.find('\0'); end != std::string::npos; end = all.find('\0', at)) {
    out.push_back(all.substr(at, end - at));
    at = end + 1;
  }
  if (at == all.size()) return out;
  fail_input(name.file, text("array '", name.array, "'"), "its last string does not end",
             "the file is damaged");
}

std::vector<double> VtkDocument::reals(pugi::xml_node array, std::uint64_t count) {
  const ArrayName name = name_of(array, file());
  const NumberType type = type_of(array, name);
  if (std::string_view(array.attribute("format").as_string("ascii")) != "ascii") {
    return reals_of_bytes(bytes_of(array, type, count, name), type, encoding_.order);
  }
  auto numbers = reals_of_text(array.text().get(), name);
  check_count(numbers.size(), count, name);
  return numbers;
}

}  // namespace mw::io
