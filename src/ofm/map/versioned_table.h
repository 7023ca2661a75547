// Objects by id, of which an immutable copy of all can be had at any time for the price of a list
// of pointers.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {

/// An immutable view of a VersionedTable: object by id, null where it was removed.
template <class Id, class T>
class TableSnapshot {
 public:
  TableSnapshot() = default;
  explicit TableSnapshot(std::vector<std::shared_ptr<const T>> objects)
      : objects_(std::move(objects)) {}

  /// Null where there is no such object.
  const T* Find(Id id) const {
    return id.value < objects_.size() ? objects_[id.value].get() : nullptr;
  }
  /// Number of ids that were issued; the next one.
  std::size_t ids_issued() const { return objects_.size(); }
  /// Calls `visit(const T&)` by increasing id.
  template <class Visit>
  void ForEach(Visit&& visit) const {
    for (const auto& object : objects_) {
      if (object) visit(*object);
    }
  }

 private:
  template <class, class>
  friend class VersionedTable;

  std::vector<std::shared_ptr<const T>> objects_;
};

/// Owner of objects with ids issued in increasing order. An object that a snapshot shares is copied
/// before it is changed, so a snapshot never changes and its reader needs no lock. One writer.
template <class Id, class T>
class VersionedTable {
 public:
  VersionedTable() = default;
  /// A table that goes on from `snapshot`, under the same ids.
  explicit VersionedTable(const TableSnapshot<Id, T>& snapshot) : version_(1) {
    slots_.reserve(snapshot.objects_.size());
    for (const auto& object : snapshot.objects_) {
      // Of version 0, so that it is copied before it is changed.
      slots_.push_back({std::const_pointer_cast<T>(object), 0});
      size_ += object != nullptr;
    }
  }

  /// Takes ownership; sets and returns the object's id.
  Id Insert(T object) {
    const Id id(static_cast<std::uint32_t>(slots_.size()));
    object.id = id;
    slots_.push_back({std::make_shared<T>(std::move(object)), version_});
    ++size_;
    return id;
  }

  const T* Find(Id id) const {
    return id.value < slots_.size() ? slots_[id.value].object.get() : nullptr;
  }
  const T& Get(Id id) const {
    const T* object = Find(id);
    OFM_CHECK(object != nullptr);
    return *object;
  }
  /// The object for writing; references from before are stale.
  T& Edit(Id id) {
    OFM_CHECK(Find(id) != nullptr);
    Slot& slot = slots_[id.value];
    if (slot.version != version_) {
      slot.object = std::make_shared<T>(*slot.object);
      slot.version = version_;
    }
    return *slot.object;
  }
  void Erase(Id id) {
    OFM_CHECK(Find(id) != nullptr);
    slots_[id.value].object.reset();
    --size_;
  }

  std::size_t size() const { return size_; }
  template <class Visit>
  void ForEach(Visit&& visit) const {
    for (const Slot& slot : slots_) {
      if (slot.object) visit(static_cast<const T&>(*slot.object));
    }
  }

  TableSnapshot<Id, T> Snapshot() {
    ++version_;
    std::vector<std::shared_ptr<const T>> objects;
    objects.reserve(slots_.size());
    for (const Slot& slot : slots_) objects.push_back(slot.object);
    return TableSnapshot<Id, T>(std::move(objects));
  }

 private:
  struct Slot {
    std::shared_ptr<T> object;
    std::uint64_t version = 0;  // of the table when the object was made or copied
  };

  std::vector<Slot> slots_;  // by id
  std::size_t size_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace ofm
