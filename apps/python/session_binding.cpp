// SPDX-License-Identifier: Apache-2.0
// Session: cameras of others, and their frames.
#include <pybind11/stl.h>

#include "base/error.h"
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

    JoinedSession& get() const {
        if (!session_)
            throw Error("This session was closed.");
        return *session_;
    }
    std::unique_ptr<FramesIterator> frames() const {
        (void)get();
        return std::make_unique<FramesIterator>(read_session(session_), 0, std::nullopt);
    }
    // Needs Python's lock. It goes on where an iterator still has it.
    void close() {
        auto session = std::exchange(session_, nullptr);
        const py::gil_scoped_release released;
        session.reset();
    }

private:
    std::shared_ptr<JoinedSession> session_;
};

std::unique_ptr<SessionObject> join(const std::string& link, const std::string& name,
                                    const std::string& depth_codec,
                                    const std::string& color_codec) {
    std::shared_ptr<JoinedSession> session;
    {
        const py::gil_scoped_release released;
        session = std::make_shared<JoinedSession>(
            JoinedSession::Options{link, name, depth_codec, color_codec});
    }
    auto object = std::make_unique<SessionObject>(session);
    wait_until([&] { return session->is_joined(); });
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
            "host", [](const SessionObject& self) { return shown_text(self.get().host_name()); })
        .def_property_readonly("cameras",
                               [](const SessionObject& self) {
                                   py::list list;
                                   for (const auto& view : self.get().cameras())
                                       list.append(std::const_pointer_cast<CameraView>(view));
                                   return list;
                               })
        .def("frames", &SessionObject::frames, "The newest frames of all cameras, as they come.")
        .def("close", &SessionObject::close, "Leaves the session.")
        .def("__enter__", [](py::object self) { return self; })
        .def("__exit__", [](SessionObject& self, const py::args&) { self.close(); });
    module.def("join", &join, py::arg("link"), py::kw_only(), py::arg("name") = "python",
               py::arg("depth_codec") = "strata", py::arg("color_codec") = "jpeg:quality=85",
               "Joins a session, and waits until the host lets this program in.");
}

}  // namespace theatron::python
