// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The XML of a VTK file, and its arrays as numbers or bytes.
#include "io/vtk_xml/vtk_document.h"

#include <algorithm>
#include <new>

#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::io {
namespace {

constexpr std::string_view kAppendedTag = "<AppendedData";
constexpr std::uint64_t kChunkBytes = 1 << 20;
constexpr std::string_view kRootTag = "<VTKFile";
/// The most bytes of text, which is held in memory.
constexpr std::uint64_t kMaxTextBytes = std::uint64_t{1} << 33U;
constexpr std::uint64_t kMaxStringBytes = 64 << 20;

[[noreturn]] void fail_too_much_text(const std::string& file, std::string_view field) {
  fail_input(file, field, text("more than ", kMaxTextBytes, " bytes of text"),
             "save the arrays as binary data: appended, raw");
}

/// Appends to text, which has the source's bytes from start on, at most `count` of those that
/// follow; false at the end of the source.
bool append_chunk(const ByteSource& source, std::uint64_t start, std::uint64_t count,
                  std::string& text) {
  const std::size_t before = text.size();
  const std::uint64_t from = start + before;
  text.resize(before + (source.size_within(from + count) - from));
  source.read_at(from, std::as_writable_bytes(std::span(text)).subspan(before));
  return text.size() > before;
}

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
  // Read the XML up to the appended data, which may be binary, or all of it when there are none.
  std::string head;
  std::size_t found = std::string::npos;
  while (found == std::string::npos) {
    const std::size_t before = head.size();
    if (before > kMaxTextBytes) fail_too_much_text(source.name(), "XML");
    if (!append_chunk(source, 0, kChunkBytes, head)) break;
    if (before == 0 && head.find(kRootTag) == std::string::npos) {
      fail_input(source.name(), "XML", "no VTKFile begins here", "give a VTK XML file");
    }
    found = head.find(kAppendedTag, before - std::min(before, kAppendedTag.size()));
  }
  if (found != std::string::npos) {
    // Read the rest of the start tag and its '_', since the chunk may have cut them.
    append_chunk(source, 0, 4096, head);
    appended_ = true;
    appended_start_ = found;
    find_appended(head);
  }
  parse(std::move(head));
}

/// Takes the appended data off head and notes where and what they are.
void VtkDocument::find_appended(std::string& head) {
  const std::size_t tag = appended_start_;
  const std::size_t close = head.find('>', tag);
  const std::size_t mark = close == std::string::npos ? close : head.find('_', close);
  if (mark == std::string::npos) {
    fail_input(file(), "AppendedData", "no '_' in front of the data", "the file is truncated");
  }
  appended_raw_ = head.substr(tag, close - tag).find("base64") == std::string::npos;
  appended_start_ = mark + 1;
  head.resize(tag);
  head += "</VTKFile>";
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
  if (!compressor.empty() && encoding_.packing == VtkPacking::kNone) {
    fail_input(file(), "compressor", text(compressor, " is not supported"),
               "save uncompressed, or with zlib or LZ4");
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
      if (before > kMaxTextBytes) fail_too_much_text(file(), "AppendedData");
      if (!append_chunk(source_, appended_start_, kChunkBytes, appended_text_)) break;
      end = appended_text_.find('<', before);
    }
    appended_text_.resize(std::min(end, appended_text_.size()));
  }
  return appended_text_;
}

std::unique_ptr<ByteStream> VtkDocument::stream_of(pugi::xml_node array, const ArrayName& name) {
  const std::string_view format = array.attribute("format").as_string("ascii");
  if (format == "binary") {
    return std::make_unique<Base64Stream>(array.text().get(), name.file);
  }
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
  if (appended_raw_) return std::make_unique<SourceStream>(source_, position);
  const std::string_view all = appended_text();
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
