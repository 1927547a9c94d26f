// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// All numbers of a netCDF file are big-endian, and what is shorter than a multiple of four bytes is
// padded with zeros (NetCDF Classic Format Specification).
#include "io/mesh/exodus/netcdf_output.h"

#include <bit>

#include "io/file/errors.h"
#include "kernels/core/error.h"

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
  dimensions_.push_back({name, length});
  return static_cast<int>(dimensions_.size()) - 1;
}

int NetcdfOutput::add_variable(const std::string& name, Type type,
                               const std::vector<int>& dimensions) {
  Variable variable{.name = name, .type = type, .dimensions = dimensions};
  std::uint64_t values = 1;
  for (const int d : dimensions) values *= dimensions_[static_cast<std::size_t>(d)].length;
  const std::uint64_t value_bytes = type == Type::kText ? 1 : type == Type::kDouble ? 8 : 4;
  variable.bytes = padded(values * value_bytes);
  variables_.push_back(std::move(variable));
  return static_cast<int>(variables_.size()) - 1;
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

void NetcdfOutput::add(int variable, Attribute attribute) {
  std::vector<Attribute>& list = variable == kWholeFile
                                     ? attributes_
                                     : variables_[static_cast<std::size_t>(variable)].attributes;
  list.push_back(std::move(attribute));
}

void NetcdfOutput::add_attribute(int variable, const std::string& name, const std::string& value) {
  add(variable, {name, Type::kText, value.size(), value});
}

void NetcdfOutput::add_attribute(int variable, const std::string& name, int value) {
  std::string bytes;
  append_word(bytes, static_cast<std::uint32_t>(value));
  add(variable, {name, Type::kInteger, 1, bytes});
}

void NetcdfOutput::add_attribute(int variable, const std::string& name, float value) {
  std::string bytes;
  append_word(bytes, std::bit_cast<std::uint32_t>(value));
  add(variable, {name, Type::kFloat, 1, bytes});
}

std::string NetcdfOutput::header() const {
  std::string out("CDF\x02");
  append_word32(out, 0);  // no records
  append_list_head(out, kDimensions, dimensions_.size());
  for (const Dimension& dimension : dimensions_) {
    append_name(out, dimension.name);
    append_word32(out, dimension.length);
  }
  const auto append_attributes = [&](const std::vector<Attribute>& attributes) {
    append_list_head(out, kAttributes, attributes.size());
    for (const Attribute& attribute : attributes) {
      append_name(out, attribute.name);
      append_word(out, static_cast<std::uint32_t>(attribute.type));
      append_word32(out, attribute.count);
      append_padded(out, attribute.bytes);
    }
  };
  append_attributes(attributes_);
  append_list_head(out, kVariables, variables_.size());
  for (const Variable& variable : variables_) {
    append_name(out, variable.name);
    append_word32(out, variable.dimensions.size());
    for (const int d : variable.dimensions) append_word32(out, static_cast<std::uint64_t>(d));
    append_attributes(variable.attributes);
    append_word(out, static_cast<std::uint32_t>(variable.type));
    append_word32(out, variable.bytes);
    append_word(out, variable.begin);
  }
  return out;
}

void NetcdfOutput::begin_data() {
  std::uint64_t end = header().size();
  for (Variable& variable : variables_) {
    if (variable.bytes > kMaxVariableBytes) {
      throw Error(ErrorKind::kUsage,
                  text(name_, ": the mesh is too large for the format; write .vtkhdf"));
    }
    variable.begin = end;
    end += variable.bytes;
  }
  const std::string bytes = header();
  file_.resize(end);
  file_.write_at(0, std::as_bytes(std::span(bytes)));
}

void NetcdfOutput::write(int variable, std::uint64_t offset, const std::string& bytes) {
  const Variable& to = variables_[static_cast<std::size_t>(variable)];
  file_.write_at(to.begin + offset, std::as_bytes(std::span(bytes)));
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
