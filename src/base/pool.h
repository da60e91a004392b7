// SPDX-License-Identifier: Apache-2.0
// Objects whose memory is used again, so that a running pipeline allocates nothing.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace theatron {

// Hands out objects with the memory, and the stale content, of released ones.
// Thread safe. Objects may outlive the pool.
template <class T>
class Pool {
public:
    std::shared_ptr<T> take() {
        std::unique_ptr<T> object;
        {
            const std::lock_guard lock(shelf_->mutex);
            if (!shelf_->objects.empty()) {
                object = std::move(shelf_->objects.back());
                shelf_->objects.pop_back();
            }
        }
        if (!object)
            object = std::make_unique<T>();
        return std::shared_ptr<T>(
            object.release(),
            [shelf = shelf_](T* used) {
                std::unique_ptr<T> back(used);
                const std::lock_guard lock(shelf->mutex);
                if (shelf->objects.size() < max_kept)
                    shelf->objects.push_back(std::move(back));
            },
            CountAllocator<T>{shelf_});
    }

private:
    static constexpr std::size_t max_kept = 16;
    struct Shelf {
        std::mutex mutex;
        std::vector<std::unique_ptr<T>> objects;
        std::vector<void*> counts;  // memory of reference counts, all of one size
        ~Shelf() {
            for (void* count : counts)
                ::operator delete(count);
        }
    };
    // Reference counts are kept like the objects. The library asks for one size only.
    template <class Count>
    struct CountAllocator {
        using value_type = Count;
        std::shared_ptr<Shelf> shelf;

        explicit CountAllocator(std::shared_ptr<Shelf> s) : shelf(std::move(s)) {}
        template <class Other>
        CountAllocator(const CountAllocator<Other>& other) : shelf(other.shelf) {}

        Count* allocate(std::size_t n) {
            const std::lock_guard lock(shelf->mutex);
            if (n != 1 || shelf->counts.empty())
                return static_cast<Count*>(::operator new(n * sizeof(Count)));
            void* memory = shelf->counts.back();
            shelf->counts.pop_back();
            return static_cast<Count*>(memory);
        }
        void deallocate(Count* memory, std::size_t n) {
            const std::lock_guard lock(shelf->mutex);
            if (n == 1 && shelf->counts.size() < max_kept)
                shelf->counts.push_back(memory);
            else
                ::operator delete(memory);
        }
        template <class Other>
        bool operator==(const CountAllocator<Other>& other) const {
            return shelf == other.shelf;
        }
    };
    std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

}  // namespace theatron
