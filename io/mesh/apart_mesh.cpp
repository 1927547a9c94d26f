// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sends a mesh through a pipe, batch by batch.
#include "io/mesh/apart_mesh.h"

#include <algorithm>
#include <array>
#include <vector>

#include "io/mesh/field_names.h"

namespace mw::io {
namespace {

constexpr std::uint64_t kMaxNameBytes = 1 << 16;  ///< of one name
constexpr std::uint64_t kMaxNames = 1 << 24;
constexpr std::uint64_t kMaxValueBytes = 1 << 12;  ///< of all names of values

enum class Message : std::uint64_t { kBegin, kVertices, kTets, kValues, kFinish };

/// The head of a message, which goes ahead of what the message holds.
struct Head {
  Message message = Message::kFinish;
  std::uint64_t count = 0;  ///< rows of the batch; with kBegin, tets of the mesh
  std::uint64_t labels_signed = 0;
  std::uint64_t in_parts = 0;
  std::uint64_t ten_nodes = 0;
  std::uint64_t names = 0;         ///< with kBegin: how many follow
  std::uint64_t record_bytes = 0;  ///< with kBegin: of the record's text, ahead of the names
  std::uint64_t value_bytes = 0;   ///< with kBegin: of names of values, each with ';' behind it
};

/// Goes ahead of the letters of a name.
struct NameHead {
  RawLabel label = 0;
  std::uint64_t bytes = 0;
  std::uint64_t has_colour = 0;
  std::array<std::uint8_t, 8> colour{};  ///< four, and padding
};

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

/// Sends the mesh that the child reads to the parent.
class SendingSink : public MeshSink {
 public:
  explicit SendingSink(const SendBytes& send) : send_(send) {}

  void begin(const MeshHeader& header) override {
    const std::span<const LabelName> names = header.names.rows();
    const std::string record = record_text(header.record);
    std::string values;
    for (const std::string& name : header.values) values += name + ";";
    columns_ = header.values.size();
    send_(bytes_of(Head{Message::kBegin, header.tets, header.labels_signed ? 1U : 0U,
                        header.in_parts ? 1U : 0U, header.ten_nodes ? 1U : 0U, names.size(),
                        record.size(), values.size()}));
    send_(std::as_bytes(std::span(record)));
    send_(std::as_bytes(std::span(values)));
    for (const LabelName& row : names) {
      NameHead head{.label = row.label, .bytes = row.name.size(), .has_colour = 0};
      if (row.colour) {
        head.has_colour = 1;
        std::copy(row.colour->begin(), row.colour->end(), head.colour.begin());
      }
      send_(bytes_of(head));
      send_(std::as_bytes(std::span(row.name)));
    }
  }
  void write_vertices(std::span<const Position> positions) override {
    send_(bytes_of(Head{Message::kVertices, positions.size()}));
    send_(std::as_bytes(positions));
  }
  void write_tets(std::span<const TetRows> tets, std::span<const RawLabel> labels) override {
    send_(bytes_of(Head{Message::kTets, tets.size()}));
    send_(std::as_bytes(tets));
    send_(std::as_bytes(labels));
  }
  void write_values(std::span<const double> rows) override {
    send_(bytes_of(Head{Message::kValues, rows.size() / columns_}));
    send_(std::as_bytes(rows));
  }
  void finish() override { send_(bytes_of(Head{})); }

 private:
  const SendBytes& send_;
  std::size_t columns_ = 0;  ///< numbers that each tet has
};

/// Receives the mesh in the parent; checks counts and rows, as damaged input may break the child.
class Receiver {
 public:
  Receiver(ApartStream& stream, MeshSink& sink) : stream_(stream), sink_(sink) {}

  /// Returns whether the stream came to the end of the mesh.
  [[nodiscard]] bool receive() {
    Head head;
    if (!next(head) || head.message != Message::kBegin) return false;
    if (head.names > kMaxNames || head.record_bytes > kMaxRecordBytes ||
        head.value_bytes > kMaxValueBytes) {
      return false;
    }
    std::string record(head.record_bytes, '\0');
    if (!stream_.read(std::as_writable_bytes(std::span(record)))) return false;
    std::vector<std::string> values;
    if (!value_list(head.value_bytes, values)) return false;
    columns_ = values.size();
    std::vector<LabelName> rows;
    for (std::uint64_t i = 0; i < head.names; ++i) {
      if (!name(rows.emplace_back())) return false;
    }
    sink_.begin({.tets = head.count,
                 .labels_signed = head.labels_signed != 0,
                 .names = LabelNames(std::move(rows)),
                 .record = parse_record(record, "the mesh's record"),
                 .values = std::move(values),
                 .in_parts = head.in_parts != 0,
                 .ten_nodes = head.ten_nodes != 0});
    while (next(head)) {
      if (head.message == Message::kFinish) return true;
      if (head.count > kMaxApartRows) return false;
      const bool sound = head.message == Message::kVertices ? vertices(head.count)
                         : head.message == Message::kTets   ? tets(head.count)
                                                            : false;
      if (!sound) return false;
    }
    return false;
  }

 private:
  [[nodiscard]] bool next(Head& head) {
    return stream_.read(std::as_writable_bytes(std::span(&head, 1)));
  }

  [[nodiscard]] bool value_list(std::uint64_t bytes, std::vector<std::string>& out) {
    std::string joined(bytes, '\0');
    if (!stream_.read(std::as_writable_bytes(std::span(joined)))) return false;
    for (std::size_t at = 0; at < joined.size();) {
      const std::size_t end = joined.find(';', at);
      if (end == joined.npos) return false;
      out.push_back(joined.substr(at, end - at));
      at = end + 1;
    }
    return out.size() <= kMostValues && value_names(out) == out;
  }

  [[nodiscard]] bool name(LabelName& row) {
    NameHead head;
    if (!stream_.read(std::as_writable_bytes(std::span(&head, 1)))) return false;
    if (head.bytes > kMaxNameBytes) return false;
    row.label = head.label;
    row.name.resize(head.bytes);
    if (head.has_colour != 0) {
      row.colour.emplace();
      std::copy_n(head.colour.begin(), row.colour->size(), row.colour->begin());
    }
    return stream_.read(std::as_writable_bytes(std::span(row.name)));
  }

  [[nodiscard]] bool vertices(std::size_t count) {
    positions_.resize(count);
    if (!stream_.read(std::as_writable_bytes(std::span(positions_)))) return false;
    vertices_ += count;
    sink_.write_vertices(positions_);
    return true;
  }

  [[nodiscard]] bool tets(std::size_t count) {
    tets_.resize(count);
    labels_.resize(count);
    if (!stream_.read(std::as_writable_bytes(std::span(tets_))) ||
        !stream_.read(std::as_writable_bytes(std::span(labels_)))) {
      return false;
    }
    for (const TetRows& tet : tets_) {
      if (*std::max_element(tet.begin(), tet.end()) >= vertices_) return false;
    }
    sink_.write_tets(tets_, labels_);
    return columns_ == 0 || values(count);
  }

  /// Takes the values of the tets that came last.
  [[nodiscard]] bool values(std::size_t count) {
    Head head;
    if (!next(head) || head.message != Message::kValues || head.count != count) return false;
    values_.resize(count * columns_);
    if (!stream_.read(std::as_writable_bytes(std::span(values_)))) return false;
    sink_.write_values(values_);
    return true;
  }

  ApartStream& stream_;
  MeshSink& sink_;
  std::uint64_t vertices_ = 0;
  std::size_t columns_ = 0;  ///< numbers that each tet has
  std::vector<Position> positions_;
  std::vector<TetRows> tets_;
  std::vector<RawLabel> labels_;
  std::vector<double> values_;
};

}  // namespace

std::string pass_mesh_apart(const ApartLimits& limits, const std::function<void(MeshSink&)>& read,
                            MeshSink& sink) {
  bool finished = false;
  const auto work = [&](const SendBytes& send) {
    SendingSink out(send);
    read(out);
  };
  const auto consume = [&](ApartStream& stream) { finished = Receiver(stream, sink).receive(); };
  std::string death = stream_apart(limits, work, consume);
  if (!death.empty() || finished) return death;
  return "it did not finish the mesh";
}

}  // namespace mw::io
