// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All numbers of a netCDF file are big-endian, and what is shorter than a multiple of four bytes is
// padded with zeros (NetCDF Classic Format Specification).
#include "io/mesh/exodus/netcdf_output.h"

#include <algorithm>
#include <bit>

#include "io/file/errors.h"
#include "kernels/core/assert.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMaxVariableBytes = (std::uint64_t{1} << 32U) - 4;
constexpr std::uint64_t kPadding = 4;
// The tags of lists.
constexpr std::uint32_t kDimensions = 10, kVariables = 11, kAttributes = 12;

template <class Word>
void append_word(std::string& out, Word word) {
  for (std::size_t byte = sizeof(Word); byte-- > 0;) {
    out += static_cast<char>(word >> (8 * byte) & 0xffU);
  }
}

void append_word32(std::string& out, std::uint64_t word) {
  append_word(out, static_cast<std::uint32_t>(word));
}

std::uint64_t padded(std::uint64_t bytes) {
  return (bytes + kPadding - 1) / kPadding * kPadding;
}

void append_padded(std::string& out, const std::string& bytes) {
  out += bytes;
  out.append(padded(bytes.size()) - bytes.size(), '\0');
}

void append_name(std::string& out, const std::string& name) {
  append_word32(out, name.size());
  append_padded(out, name);
}

/// Appends the head of a list; an empty list is two zeros.
void append_list_head(std::string& out, std::uint32_t tag, std::size_t members) {
  append_word32(out, members == 0 ? 0 : tag);
  append_word32(out, members);
}

}  // namespace

int NetcdfOutput::add_dimension(const std::string& name, std::uint64_t length) {
  std::string bytes;
  append_name(bytes, name);
  append_word32(bytes, length);
  dimensions_.append(bytes);
  lengths_.append(length);
  return static_cast<int>(lengths_.size()) - 1;
}

int NetcdfOutput::add_variable(const std::string& name, Type type,
                               const std::vector<int>& dimensions) {
  close_variable();
  open_.emplace(Variable{.type = type});
  append_name(open_->head, name);
  append_word32(open_->head, dimensions.size());
  std::uint64_t values = 1;
  for (const int d : dimensions) {
    values *= lengths_[static_cast<std::size_t>(d)];
    append_word32(open_->head, static_cast<std::uint64_t>(d));
  }
  const std::uint64_t value_bytes = type == Type::kText ? 1 : type == Type::kDouble ? 8 : 4;
  open_->bytes = padded(values * value_bytes);
  return static_cast<int>(places_.size());
}

/// Writes what tells of the last variable, except for its place, and finds that.
void NetcdfOutput::close_variable() {
  if (!open_) return;
  if (open_->bytes > kMaxVariableBytes) {
    fail_usage(name_, ": the mesh is too large for the format; write .vtkhdf");
  }
  std::string bytes = open_->head;
  append_list_head(bytes, kAttributes, open_->attributes.members);
  bytes += open_->attributes.bytes;
  append_word(bytes, static_cast<std::uint32_t>(open_->type));
  append_word32(bytes, open_->bytes);
  variables_.append(bytes);
  places_.append({.end_of_head = variables_.size(), .begin = data_bytes_});
  data_bytes_ += open_->bytes;
  open_.reset();
}

int NetcdfOutput::add_integers(const std::string& name, const std::vector<int>& dimensions) {
  return add_variable(name, Type::kInteger, dimensions);
}

int NetcdfOutput::add_doubles(const std::string& name, const std::vector<int>& dimensions) {
  return add_variable(name, Type::kDouble, dimensions);
}

int NetcdfOutput::add_texts(const std::string& name, const std::vector<int>& dimensions) {
  return add_variable(name, Type::kText, dimensions);
}

void NetcdfOutput::add(int variable, const std::string& name, Type type, std::uint64_t count,
                       const std::string& bytes) {
  MW_ASSERT(variable == kWholeFile || (open_ && variable == static_cast<int>(places_.size())));
  Attributes& list = variable == kWholeFile ? attributes_ : open_->attributes;
  ++list.members;
  append_name(list.bytes, name);
  append_word(list.bytes, static_cast<std::uint32_t>(type));
  append_word32(list.bytes, count);
  append_padded(list.bytes, bytes);
}

void NetcdfOutput::add_attribute(int variable, const std::string& name, const std::string& value) {
  add(variable, name, Type::kText, value.size(), value);
}

void NetcdfOutput::add_attribute(int variable, const std::string& name, int value) {
  std::string bytes;
  append_word(bytes, static_cast<std::uint32_t>(value));
  add(variable, name, Type::kInteger, 1, bytes);
}

void NetcdfOutput::add_attribute(int variable, const std::string& name, float value) {
  std::string bytes;
  append_word(bytes, std::bit_cast<std::uint32_t>(value));
  add(variable, name, Type::kFloat, 1, bytes);
}

void NetcdfOutput::begin_data() {
  close_variable();
  // The magic number, the number of records and the heads of three lists are words of 4 bytes.
  constexpr std::uint64_t kOfHeads = 8 * sizeof(std::uint32_t);
  header_bytes_ = kOfHeads + dimensions_.size() + attributes_.bytes.size() + variables_.size() +
                  places_.size() * sizeof(std::uint64_t);
  file_.resize(header_bytes_ + data_bytes_);
  write_header();
}

void NetcdfOutput::write_header() {
  constexpr std::size_t kBatchBytes = 1 << 20;
  std::string out("CDF\x02");
  std::uint64_t written = 0;
  const auto flush = [&](std::size_t at_least) {
    if (out.size() < at_least) return;
    file_.write_at(written, std::as_bytes(std::span(out)));
    written += out.size();
    out.clear();
  };
  const auto copy = [&](ScratchFile& from, std::uint64_t begin, std::uint64_t end) {
    const std::size_t before = out.size();
    out.resize(before + (end - begin));
    from.read_at(begin, std::as_writable_bytes(std::span(out).subspan(before)));
    flush(kBatchBytes);
  };
  append_word32(out, 0);  // no records
  append_list_head(out, kDimensions, lengths_.size());
  for (std::uint64_t at = 0; at < dimensions_.size(); at += kBatchBytes) {
    copy(dimensions_, at, std::min(at + kBatchBytes, dimensions_.size()));
  }
  append_list_head(out, kAttributes, attributes_.members);
  out += attributes_.bytes;
  append_list_head(out, kVariables, places_.size());
  std::uint64_t begin = 0;
  for (std::uint64_t v = 0; v < places_.size(); ++v) {
    const Place place = places_[v];
    copy(variables_, begin, place.end_of_head);
    append_word(out, header_bytes_ + place.begin);
    begin = place.end_of_head;
  }
  flush(1);
}

void NetcdfOutput::write(int variable, std::uint64_t offset, const std::string& bytes) {
  const std::uint64_t begin = header_bytes_ + places_[static_cast<std::size_t>(variable)].begin;
  file_.write_at(begin + offset, std::as_bytes(std::span(bytes)));
}

void NetcdfOutput::put(int variable, std::uint64_t first, std::span<const int> values,
                       std::size_t columns) {
  std::string bytes;
  bytes.reserve(values.size() * sizeof(std::uint32_t));
  for (const int value : values) append_word(bytes, static_cast<std::uint32_t>(value));
  write(variable, first * columns * sizeof(std::uint32_t), bytes);
}

void NetcdfOutput::put(int variable, std::uint64_t first, std::span<const double> values) {
  std::string bytes;
  bytes.reserve(values.size() * sizeof(std::uint64_t));
  for (const double value : values) append_word(bytes, std::bit_cast<std::uint64_t>(value));
  write(variable, first * sizeof(std::uint64_t), bytes);
}

void NetcdfOutput::put_text(int variable, std::uint64_t row, const std::string& value,
                            std::size_t max_bytes) {
  std::string text = value.substr(0, max_bytes);
  text.resize(max_bytes + 1, '\0');
  write(variable, row * text.size(), text);
}

}  // namespace mw::io
