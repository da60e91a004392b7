// SPDX-License-Identifier: Apache-2.0
// Session: cameras of others, and their frames.
#include <pybind11/stl.h>

#include "base/error.h"
#include "base/steady_clock.h"
#include "bindings.h"
#include "frames_iterator.h"
#include "joined_session.h"
#include "shown_text.h"
#include "waits.h"

namespace theatron::python {
namespace {

namespace py = pybind11;

class SessionObject {
public:
    explicit SessionObject(std::shared_ptr<JoinedSession> session) : session_(std::move(session)) {}
    ~SessionObject() { close(); }
    SessionObject(const SessionObject&) = delete;
    SessionObject& operator=(const SessionObject&) = delete;

    std::shared_ptr<JoinedSession> get() const {
        if (!session_)
            throw Error("This session was closed.");
        return session_;
    }
    std::unique_ptr<FramesIterator> frames() const {
        return std::make_unique<FramesIterator>(read_session(get()), 0, std::nullopt);
    }
    // Needs Python's lock. Loops over its frames end.
    void close() {
        auto session = std::exchange(session_, nullptr);
        const py::gil_scoped_release released;
        session.reset();
    }

private:
    std::shared_ptr<JoinedSession> session_;
};

std::string given_up(const std::string& problem) {
    return problem.empty() ? "The host did not answer; see that it runs and that the network lets "
                             "this computer through to the port in the link."
                           : problem;
}

std::unique_ptr<SessionObject> join(const std::string& link, const std::string& name,
                                    const std::string& depth_codec, const std::string& color_codec,
                                    double wait) {
    constexpr double longest_wait = 1e6;
    if (!(wait > 0 && wait <= longest_wait))
        throw py::value_error("wait is a time in seconds, above 0.");
    std::shared_ptr<JoinedSession> session;
    {
        const py::gil_scoped_release released;
        session = std::make_shared<JoinedSession>(
            JoinedSession::Options{link, name, depth_codec, color_codec});
    }
    // It has the session alone, so that the session ends without Python's lock.
    auto object = std::make_unique<SessionObject>(std::move(session));
    TimePoint until = steady_now() + seconds_to_duration(wait);
    wait_until([&] {
        const std::shared_ptr<JoinedSession> joining = object->get();
        if (joining->is_joined())
            return true;
        if (joining->is_at_door())
            until = steady_now() + seconds_to_duration(wait);
        else if (steady_now() >= until)
            throw Error(given_up(joining->problem()));
        return false;
    });
    return object;
}

}  // namespace

void bind_session(py::module_& module) {
    py::class_<CameraView, std::shared_ptr<CameraView>>(module, "SessionCamera",
                                                        "A camera of a session.")
        .def_property_readonly("number", &CameraView::number)
        .def_property_readonly("name",
                               [](const CameraView& self) { return shown_text(self.name()); })
        .def_property_readonly("calibration",
                               [](const CameraView& self) { return self.calibration(); })
        .def("__repr__", [](const CameraView& self) {
            return shown_text("SessionCamera(number=" + std::to_string(self.number()) + ", name='" +
                              self.name() + "')");
        });
    py::class_<SessionObject>(module, "Session", "A joined session.")
        .def_property_readonly(
            "host", [](const SessionObject& self) { return shown_text(self.get()->host_name()); })
        .def_property_readonly("cameras",
                               [](const SessionObject& self) {
                                   const auto session = self.get();
                                   std::vector<std::shared_ptr<const CameraView>> cameras;
                                   {
                                       const py::gil_scoped_release released;
                                       cameras = session->cameras();
                                   }
                                   py::list list;
                                   for (const auto& view : cameras)
                                       list.append(std::const_pointer_cast<CameraView>(view));
                                   return list;
                               })
        .def("frames", &SessionObject::frames, py::keep_alive<0, 1>(),
             "The newest frames of all cameras, as they come.")
        .def("close", &SessionObject::close, "Leaves the session.")
        .def("__enter__", [](py::object self) { return self; })
        .def("__exit__", [](SessionObject& self, const py::args&) { self.close(); });
    module.def("join", &join, py::arg("link"), py::kw_only(), py::arg("name") = "python",
               py::arg("depth_codec") = "strata", py::arg("color_codec") = "jpeg:quality=85",
               py::arg("wait") = 15.0,
               "Joins a session, and waits until the host lets this program in.");
}

}  // namespace theatron::python
