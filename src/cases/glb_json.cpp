// SPDX-License-Identifier: Apache-2.0
#include "cases/glb_json.h"

#include <cmath>

namespace theatron::cases::glb {

const Json& no_list() {
    static const Json none = Json::array();
    return none;
}

const Json& list_of(const Json& object, const char* name) {
    if (!object.is_object())
        return no_list();
    const auto found = object.find(name);
    return found != object.end() && found->is_array() ? *found : no_list();
}

std::size_t whole_of(const Json& number) {
    if (number.is_number_unsigned())
        return number.get<std::size_t>();
    constexpr double most = 1e15;
    const double value = number.is_number_float() ? number.get<double>() : -1;
    return value >= 0 && value <= most && value == std::floor(value) ? std::size_t(value)
                                                                     : no_index;
}

std::optional<std::size_t> index_of(const Json& object, const char* name) {
    if (!object.is_object())
        return std::nullopt;
    const auto found = object.find(name);
    if (found == object.end() || found->is_null())
        return std::nullopt;
    return whole_of(*found);
}

std::string text_of(const Json& object, const char* name) {
    if (!object.is_object())
        return "";
    const auto found = object.find(name);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

bool has_extension(const Json& object, const char* name) {
    if (!object.is_object())
        return false;
    const auto all = object.find("extensions");
    return all != object.end() && all->is_object() && all->contains(name);
}

const Json& extension_in(const Json& object, const char* name) {
    return has_extension(object, name) ? object["extensions"][name] : no_list();
}

}  // namespace theatron::cases::glb
