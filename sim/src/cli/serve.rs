//! `awl-sim --serve`: the simulator as a PLC on the network.

use std::io::{Write, stdout};
use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr, ToSocketAddrs};

use anyhow::{Context, Error, Result, bail};
use awl_sim::machine::Mode;
use awl_sim::open::Opened;
use awl_sim::plant::PlantSpec;
use awl_sim::run::Course;
use awl_sim::serve::{Access, Change, Server, is_here};
use awl_sim::time::format_time;

use super::inputs::{Known, parse_plant, program_files, read_scenario};
use super::report;
use awl_sim::args::{Args, On};
use awl_sim::suite::errors;

/// Runs the PLC until Ctrl-C.
pub fn serve(args: &Args, address: &str) -> Result<()> {
    if args.on != On::Host {
        bail!("--serve runs the program on this computer: it goes with --on host only");
    }
    let access = Access { anywhere: args.serve_anywhere, writes: args.serve_writes };
    let addresses = resolve(address, access)?;
    let Opened { mut machine, symbols, scan_ms, warnings, overwritten, .. } =
        program_files(args).open_host()?;
    errors::show(&warnings, args.messages);
    let plant = args.plant.as_deref().map(parse_plant).transpose()?;
    let known = Known { symbols: &symbols, overwritten: &overwritten };
    let scenario = read_scenario(args, known, plant.as_ref(), &mut *machine)?;
    let spec = plant.or_else(|| scenario.plant.clone());
    let model = spec
        .as_ref()
        .map(PlantSpec::build)
        .transpose()
        .map_err(|error| Error::msg(error.message))?;
    let scan_ms = args.scan_time.or(scenario.scan_ms).or(scan_ms).unwrap_or(1);

    let server = Server::listen(&addresses, access)
        .with_context(|| format!("cannot listen on {address}"))?;
    let stopper = server.stopper();
    ctrlc::set_handler(move || stopper.stop()).context("cannot wait for Ctrl-C")?;
    announce(server.address(), access)?;
    let course = Course::new(&scenario, model, scan_ms);
    let outcome = server.run(&mut machine, course, scan_ms, &mut tell)?;
    let plant = spec.as_ref().map(PlantSpec::name);
    report::print(&scenario.origin, plant, &outcome, true, args.messages.quiet);
    Ok(())
}

/// The socket addresses of `--serve`, all of which may be listened at.
fn resolve(text: &str, access: Access) -> Result<Vec<SocketAddr>> {
    if !text.contains(':') {
        match text.parse::<u16>() {
            Ok(port) => bail!("--serve {text}: the host is missing: 127.0.0.1:{port}"),
            Err(_) => bail!("--serve {text}: the port is missing: {text}:1502"),
        }
    }
    if text.starts_with(':') {
        bail!("--serve {text}: the host is missing: 127.0.0.1{text}");
    }
    let addresses = text
        .to_socket_addrs()
        .with_context(|| format!("--serve {text} is no address such as 127.0.0.1:1502"))?;
    let addresses: Vec<_> = addresses.collect();
    if let Some(address) = addresses.iter().find(|&&address| !access.allows_listening_at(address)) {
        bail!(
            "--serve {text}: other computers reach {}, and Modbus has no passwords: whoever \
                reaches the port is answered. \
             With --serve-anywhere they may read, with --serve-writes too they may write",
            address.ip()
        );
    }
    Ok(addresses)
}

/// Says where the PLC is to be found, for whom, and how to look at it.
fn announce(address: SocketAddr, access: Access) -> Result<()> {
    let whom = match (is_here(address.ip()), access.writes) {
        (true, _) => "this computer reads and writes",
        (false, false) => "every computer reads, this one writes",
        (false, true) => "every computer reads and writes",
    };
    let mut here = address;
    match address {
        SocketAddr::V4(v4) if v4.ip().is_unspecified() => here.set_ip(Ipv4Addr::LOCALHOST.into()),
        SocketAddr::V6(v6) if v6.ip().is_unspecified() => here.set_ip(Ipv6Addr::LOCALHOST.into()),
        _ => {}
    }
    let mut out = stdout();
    writeln!(
        out,
        "Modbus TCP on {address}: {whom}; look: uno200 --tcp {here} status; end: Ctrl-C"
    )?;
    Ok(out.flush()?)
}

/// Shows what an operator at the machine would see.
fn tell(change: &Change) {
    let at = format_time(change.at_ms);
    match (change.mode, &change.fault) {
        (Mode::Run, _) => anstream::eprintln!("{at}: RUN"),
        (Mode::Stop, None) => anstream::eprintln!("{at}: STOP"),
        (Mode::Stop, Some(fault)) => anstream::eprintln!("{at}: STOP: {fault}"),
    }
}
