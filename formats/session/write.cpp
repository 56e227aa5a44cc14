// Writer of sessions. Shared data is found by its address first, so that each array is hashed once,
// not once per level.
#include <cmath>

#include "base/bit_cast.h"
#include "base/error.h"
#include "formats/formats.h"
#include "formats/session/layout.h"
#include "formats/session/pool.h"
#include "formats/vtk/polydata.h"

namespace mvs::core {
namespace {

class SessionWriter {
 public:
  void write(const Snapshot &snapshot) { pass(*this, snapshot); }
  void put_into(H5Tree &tree);

  // the archive functions of layout.h
  void word(uint64_t number) { words_.push_back(number); }
  void word(int64_t number) { word(static_cast<uint64_t>(number)); }
  void word(uint32_t number) { word(uint64_t{number}); }
  void word(Enum auto kind) { word(static_cast<uint64_t>(kind)); }
  void choice(RecordedEvent::Kind kind) { word(uint64_t{kind}); }
  void number(double value);
  void text(std::string_view text);
  template <typename Element>
  void array(const CowVector<Element> &items);
  template <typename Part>
  void list(const CowVector<Part> &parts);
  void model(const ModelPtr &model);
  void shape(const ToolShapePtr &shape);
  void points(const mvs_array &given);
  void optional_text(const char *given);
  template <typename Item>
  void list(const PersistentList<Item> &items);
  void check(const ModelState &) {}
  void check(const RecordedEvent &) {}
  void optional(const std::shared_ptr<const ModelState> &current);
  void optional(const std::shared_ptr<const std::vector<Checkpoint>> &checkpoints);

 private:
  // Stores the words that work() writes as a part, and returns its number.
  template <typename Work>
  uint64_t part(Work work) {
    std::vector<uint64_t> around;
    around.swap(words_);
    work();
    around.swap(words_);
    return parts_.add(around.data(), around.size());
  }
  // The same for an object with an address: work() runs at its first reference only.
  template <typename Work>
  void part_at(const void *address, Work work) {
    const auto place = at_.find(address);
    word(place != at_.end() ? place->second : at_.emplace(address, part(work)).first->second);
  }

  void item(const RecordedEvent &event) { pass(*this, event); }
  void item(const std::shared_ptr<const HistoryEntry> &entry);
  void operation(const Operation &op);

  std::vector<uint64_t> words_;
  PoolWriter<uint64_t> parts_;
  PoolWriter<double> numbers_;
  PoolWriter<uint32_t> indices_;
  PoolWriter<uint8_t> texts_;
  std::map<const void *, uint64_t> at_;
  std::vector<CowVector<Vec3>> points_;  // kept alive, so that addresses stay unique
};

void SessionWriter::put_into(H5Tree &tree) {
  tree.arrays["mvs/snapshot"] = {std::move(words_)};
  parts_.put_into(tree, "mvs/parts");
  numbers_.put_into(tree, "mvs/numbers");
  indices_.put_into(tree, "mvs/indices");
  texts_.put_into(tree, "mvs/texts");
}

void must_be_finite(double number) {
  MVS_MUST(std::isfinite(number), MVS_E_DIVERGED, "",
           "a number of the valve, its state or its history is not finite: go back to an earlier "
           "state and save that");
}

void SessionWriter::number(double value) {
  must_be_finite(value);
  word(bit_cast<uint64_t>(value));
}

void SessionWriter::text(std::string_view text) {
  word(texts_.add(reinterpret_cast<const uint8_t *>(text.data()), text.size()));
}

template <typename Element>
void SessionWriter::array(const CowVector<Element> &items) {
  using Value = typename Stored<Element>::Value;
  const auto place = at_.find(items.buffer());
  if (place != at_.end()) return word(place->second);
  std::vector<Value> values;
  values.reserve(items.size() * Stored<Element>::columns);
  for (const Element &item : items) {
    if constexpr (Stored<Element>::columns == 1) {
      values.push_back(item);
    } else {
      for (size_t k = 0; k < Stored<Element>::columns; ++k) values.push_back(item[k]);
    }
  }
  uint64_t number = 0;
  if constexpr (std::is_same_v<Value, double>) {
    for (const double value : values) must_be_finite(value);
    number = numbers_.add(values.data(), values.size());
  } else {
    number = indices_.add(values.data(), values.size());
  }
  if (items.buffer()) at_.emplace(items.buffer(), number);
  word(number);
}

template <typename Part>
void SessionWriter::list(const CowVector<Part> &parts) {
  const auto all = [&] {
    word(uint64_t{parts.size()});
    for (const Part &one : parts) pass(*this, one);
  };
  if (parts.buffer()) return part_at(parts.buffer(), all);
  word(part(all));
}

void SessionWriter::model(const ModelPtr &model) {
  part_at(model.get(), [&] { pass(*this, model->valve); });
}

void SessionWriter::shape(const ToolShapePtr &shape) {
  const auto all = [&] {
    word(uint64_t{shape ? shape->bodies().size() : 0});
    if (!shape) return;
    for (const ToolBody &body : shape->bodies()) pass(*this, body);
  };
  if (shape) return part_at(shape.get(), all);
  word(part(all));
}

template <typename Item>
void SessionWriter::list(const PersistentList<Item> &items) {
  word(part([&] {
    word(uint64_t{items.size()});
    for (const Item *one : items.items()) item(*one);
  }));
}

void SessionWriter::item(const std::shared_ptr<const HistoryEntry> &entry) {
  part_at(entry.get(), [&] {
    operation(entry->op);
    pass_rest(*this, *entry);
  });
}

void SessionWriter::optional(const std::shared_ptr<const ModelState> &current) {
  word(uint64_t{current != nullptr});
  if (current) pass(*this, *current);
}

void SessionWriter::optional(const std::shared_ptr<const std::vector<Checkpoint>> &checkpoints) {
  word(uint64_t{checkpoints ? checkpoints->size() : 0});
  if (!checkpoints) return;
  for (const Checkpoint &checkpoint : *checkpoints) pass(*this, checkpoint);
}

// Writes names of ops.def, so that kinds and fields can be added.
void SessionWriter::operation(const Operation &op) {
  text(op.kind().name);
  word(uint64_t{op.kind().fields.size()});
  for (const OpField &f : op.kind().fields) {
    text(f.name);
    word(f.type);
    pass_field(*this, f, &op.field<char>(f));
  }
}

void SessionWriter::points(const mvs_array &given) {
  array(points_.emplace_back(points_of(given)));
}

void SessionWriter::optional_text(const char *given) {
  word(uint64_t{given != nullptr});
  text(given ? given : std::string_view());
}

}  // namespace

std::string write_session(const Snapshot &snapshot, const std::vector<VtpArray> &arrays) {
  SessionWriter writer;
  writer.write(snapshot);
  H5Tree tree;
  writer.put_into(tree);
  const ModelState &now = snapshot.current;
  add_vtk_hdf(tree, make_vtk_polydata(*now.model, now.state, arrays));
  return write_h5(tree, session_version);
}

}  // namespace mvs::core
