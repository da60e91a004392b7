// SPDX-License-Identifier: Apache-2.0
#include "host_flags.h"

#include "cli/seconds_option.h"
#include "host/host_identity.h"
#include "host/page.h"

namespace theatron::app {

void add_host_options(CLI::App& command, HostFlags& flags) {
    add_session_options(command, flags.first);
    command.add_option("--listen", flags.listen, "ADDRESS:PORT; port 0 lets the system choose")
        ->capture_default_str();
    auto* certificate = command.add_option(
        "--certificate", flags.certificate,
        "Your organisation's certificate as a PEM file, with those of its issuers, so that "
        "browsers do not warn (docs/hospital_it.md); by default the host makes one itself. It is "
        "read again when it changes");
    auto* key =
        command.add_option("--key", flags.key, "Its key, a PEM file that only you may read");
    certificate->needs(key);
    key->needs(certificate);
    command.add_flag("--hsts", flags.port.insists_on_https,
                     "With --certificate: browsers use only HTTPS for this name for a year "
                     "(Strict-Transport-Security)");
    command
        .add_option("--public-name", flags.port.public_name,
                    "NAME or NAME:PORT under which participants reach this host: part of the "
                    "links; requests for other names are refused")
        ->check([](const std::string& text) -> std::string {
            return text.empty() ? "it is empty; say NAME or NAME:PORT, or leave it out" : "";
        });
    command
        .add_option("--behind-proxy", flags.port.proxies,
                    "ADDRESS or NETWORK/BITS of a proxy (nginx, Caddy) whose X-Forwarded-For is "
                    "believed; repeat for more. Needs --public-name and --proxy-certificate")
        ->allow_extra_args(false);
    command.add_option("--proxy-certificate", flags.proxy_certificate,
                       "The proxy's certificate as a PEM file, for the links; read again when it "
                       "changes");
    command
        .add_option("--session,--name", flags.first.options.name,
                    "The session's name, which participants see. A second --session begins "
                    "another session of this host, with the options of a session behind it: "
                    "--camera, --places, --region, --cases, --recordings, --identifiers-for, "
                    "--filter, --link-hours, --admit and --look-back")
        ->capture_default_str();
    command.add_option(
        "--link-host", flags.port.link_host,
        "Name or address written into the link, if participants reach this host under another");
    CLI::Option* token = command.add_option(
        "--token", flags.first.options.token,
        "The join token, at least 16 characters; by default one is made at first start and kept");
    command
        .add_option("--token-file", flags.token_file,
                    "The same from a file that only you may read, or /dev/stdin")
        ->excludes(token);
    command.add_option("--audit", flags.audit,
                       "File for the log of people, JSON lines; none: no log (default: "
                       "audit.jsonl in the state folder)");
    command.add_option(
        "--state", flags.state,
        "Folder for the host's key, certificate and tokens (default: ~/.local/state/theatron)");
    cli::add_seconds_option(command, flags.seconds, "End by itself after this time");
    command.add_option("--summary", flags.summary,
                       "Write what went on as JSON to this file at the end");
    command.add_flag("--print-links", flags.prints_links,
                     "Print the links also where the output is no terminal, but a file or the "
                     "journal of a service, where others may read them");
    command.add_flag("--json", flags.json, "Print one JSON line with the link instead of text");
    command.add_flag("--json-log", flags.logs_json,
                     "Write the log as JSON, an object each line, and nothing else unless --json "
                     "or --print-links asks for it. Lines that begin with 'theatron: ' stay plain "
                     "text: why the host cannot start, what fails at its very end, and what "
                     "THEATRON_TARGETS sets");
    command
        .add_option("--config", flags.config,
                    "A file with these options, a line each: KEY = VALUE (docs/service.md). "
                    "An option that stands on the command line, too, is taken from there")
        ->type_name("FILE");
    command.add_flag("--check-config", flags.only_checks,
                     "Only tell what is wrong in the file of --config, with line and key");
}

host::HostOptions host_options(const HostFlags& flags) {
    host::HostOptions options{session_options(flags.first), flags.port};
    options.listen = net::parse_endpoint(flags.listen);
    options.state = flags.state;
    options.certificate = flags.certificate;
    options.key = flags.key;
    options.proxy_certificate = flags.proxy_certificate;
    options.page = host::usual_page_folder();
    options.is_audited = flags.audit != "none";
    if (options.is_audited)
        options.audit = flags.audit;
    if (!flags.token_file.empty())
        options.token = host::read_token(flags.token_file);
    return options;
}

}  // namespace theatron::app
