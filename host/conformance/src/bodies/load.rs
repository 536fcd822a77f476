//! What loading and unloading does to the program.
#![allow(unsafe_code)] // reason: asks the C library to write out what it holds back.

use std::panic::resume_unwind;
use std::process::Command;
use std::time::{Duration, Instant};

use super::super::harness::call::Layout;
use super::super::harness::subject::{Library, chars_text};
use super::super::harness::surroundings::{Surroundings, processes, threads as count_threads};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, POINTS, ask};
use super::faults::odd_cases;
use super::options::others;
use wearlaw_law::LawDescriptor;
use wearlaw_law::file_facts::FileFacts;

/// Asks the dynamic linker, without running any code of the library, which symbols nobody defines.
pub(super) fn symbols(bench: &Bench) -> Judged {
    let path = bench.needs_file()?;
    let Some(linker) = interpreter() else { return skip("this program names no dynamic linker to ask") };
    // A bare name would be searched for.
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let traced = Command::new(linker)
        .arg(&path)
        .env("LD_TRACE_LOADED_OBJECTS", "1")
        .env("LD_WARN", "yes")
        .env("LD_BIND_NOW", "yes")
        .env_remove("LD_PRELOAD")
        .output();
    let traced = match traced {
        Ok(traced) => traced,
        Err(error) => return skip(format!("the dynamic linker could not be asked: {error}")),
    };
    let said = [traced.stdout, traced.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).join("\n");
    let mut missing: Vec<&str> =
        said.lines().filter_map(|line| line.trim().strip_prefix("undefined symbol: ")).collect();
    missing.extend(said.lines().map(str::trim).filter(|line| line.contains("not defined in file")));
    let names: Vec<&str> = missing.iter().map(|line| line.split(['\t', '(']).next().unwrap_or(line).trim()).collect();
    if names.is_empty() {
        return Ok(Verdict::Pass(None));
    }
    let what = format!("nobody defines {}: link the library that does, or leave the call out", names.join(", "));
    broken(Finding::new(what).with(format!("{} undefined symbols", names.len()), "none"))
}

/// The dynamic linker that started this program (PT_INTERP of its own file).
fn interpreter() -> Option<String> {
    let bytes = std::fs::read("/proc/self/exe").ok()?;
    let word = |at: usize, size: usize| -> Option<u64> {
        let bytes = bytes.get(at..at + size)?;
        Some(bytes.iter().rev().fold(0, |all, byte| all << 8 | u64::from(*byte)))
    };
    let (table, size, count) = (word(32, 8)? as usize, word(54, 2)? as usize, word(56, 2)? as usize);
    let found = (0..count).map(|index| table + index * size).find(|at| word(*at, 4) == Some(3))?;
    let (first, length) = (word(found + 8, 8)? as usize, word(found + 32, 8)? as usize);
    let text = bytes.get(first..first + length.checked_sub(1)?)?;
    String::from_utf8(text.to_vec()).ok()
}

/// Loads, asks for the laws and has everything described, as a host does; tells the checker their names.
pub(super) fn opens(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let tables = library.tables()?;
    let mut laws = Vec::new();
    for table in &tables {
        laws.push(chars_text(&table.name));
        let task = super::super::message::Task { law: laws.last().cloned(), ..bench.task.clone() };
        // What is malformed is told by the checks of the descriptor.
        let _ = library.law(&task);
    }
    let note = match laws.as_slice() {
        [_] => None,
        several => Some(format!("{} laws: {}", several.len(), several.join(", "))),
    };
    *bench.laws() = laws;
    Ok(Verdict::Pass(note))
}

/// Loads three times, each time in a thread that ends when the library is gone, and compares what it says of itself.
pub(super) fn twice(bench: &Bench) -> Judged {
    bench.needs_file()?;
    let describe = || -> Judged<Option<LawDescriptor>> {
        let library = bench.open()?;
        library.tables()?;
        evaluate(bench, &library, 0)?;
        // What is malformed is told by the checks of the descriptor.
        let about = library.law(&bench.task).ok().map(|law| law.about.clone());
        library.close();
        Ok(about)
    };
    let in_a_thread = |time: &str| {
        bench.label(&format!("the library loaded the {time} time"));
        std::thread::scope(|scope| scope.spawn(describe).join().unwrap_or_else(|panic| resume_unwind(panic)))
    };
    let first = in_a_thread("first")?;
    for time in ["second", "third"] {
        if in_a_thread(time)? != first {
            let what = format!("the library says another thing of itself when it is loaded the {time} time");
            return broken(Finding::new(what));
        }
    }
    Ok(Verdict::Pass(None))
}

/// The whole life of a library: loaded, evaluated with good and odd inputs, unloaded.
fn live(bench: &Bench) -> Judged<()> {
    bench.needs_file()?;
    let library = bench.open()?;
    evaluate(bench, &library, 20)?;
    library.close();
    Ok(())
}

/// Evaluates good inputs and, if any are wanted, odd ones.
fn evaluate(bench: &Bench, library: &Library, odd: usize) -> Judged<()> {
    // A law that is malformed, or does not start without options, is loaded and unloaded all the same.
    let Ok(law) = library.law(&bench.task) else { return Ok(()) };
    let Ok(instance) = law.instance(&bench.task) else { return Ok(()) };
    let known = bench.known_constants(&law);
    let mut sampler = bench.sampler(&law, &known);
    let good = sampler.good(&instance, POINTS);
    let odd = if odd == 0 { Vec::new() } else { odd_cases(&mut sampler, &law.about, odd) };
    for case in good.into_iter().chain(odd) {
        ask(&law.about, &instance, &case, &Layout { text: Some(256), ..Layout::everything(&law.about) });
    }
    Ok(())
}

/// Whether anything is printed; the checker looks once more when the worker has ended.
pub(super) fn silent(bench: &Bench) -> Judged {
    bench.needs_file()?;
    let library = bench.open()?;
    if let Ok(law) = library.law(&bench.task) {
        for options in others(&bench.task) {
            drop(law.create(options.words.as_deref()));
        }
    }
    library.close();
    live(bench)?;
    // SAFETY: NULL means every stream.
    unsafe { libc::fflush(std::ptr::null_mut()) };
    Ok(Verdict::Pass(None))
}

fn compared(bench: &Bench, differ: impl Fn(&Surroundings, &Surroundings) -> Option<Finding>) -> Judged {
    let before = Surroundings::now();
    live(bench)?;
    match differ(&before, &Surroundings::now()) {
        Some(finding) => broken(finding),
        None => Ok(Verdict::Pass(None)),
    }
}

/// Whether the working directory stays.
pub(super) fn working_directory(bench: &Bench) -> Judged {
    compared(bench, |before, after| {
        (before.working_directory != after.working_directory).then(|| {
            let text =
                |s: &Surroundings| s.working_directory.as_ref().map_or("none".into(), |p| p.display().to_string());
            Finding::new("the working directory was changed").with(text(after), text(before))
        })
    })
}

/// Whether the locale stays.
pub(super) fn locale(bench: &Bench) -> Judged {
    compared(bench, |before, after| {
        (before.locale != after.locale)
            .then(|| Finding::new("the locale was changed").with(after.locale.clone(), before.locale.clone()))
    })
}

/// Whether signal handlers and the mask stay.
pub(super) fn signals(bench: &Bench) -> Judged {
    compared(bench, |before, after| {
        let changed = before.signals_changed(after);
        (!changed.is_empty()).then(|| {
            let numbers: Vec<String> = changed.iter().map(ToString::to_string).collect();
            let what = format!("the handling of signal {} was changed", numbers.join(", "));
            Finding::new(what).with("another handler, flag or mask", "all as before")
        })
    })
}

/// Whether environment variables stay.
pub(super) fn environment(bench: &Bench) -> Judged {
    compared(bench, |before, after| {
        let changed = before.environment_changed(after);
        (!changed.is_empty())
            .then(|| Finding::new(format!("environment variables were changed: {}", changed.join(", "))))
    })
}

/// How long threads of an instance may take to end once it is destroyed.
const PATIENCE: Duration = Duration::from_secs(1);
/// Libraries that keep their threads for the next parallel region.
const KEEPING: [&str; 3] = ["libgomp", "libomp", "libiomp5"];

/// Whether loading starts threads or processes, or unloading leaves some.
pub(super) fn threads(bench: &Bench) -> Judged {
    let path = bench.needs_file()?;
    let (before, processes_before) = (count_threads(), processes());
    let library = bench.open()?;
    library.tables()?;
    let (loaded, processes_loaded) = (count_threads(), processes());
    if loaded > before || processes_loaded > processes_before {
        let finding = Finding::new("loading starts threads or processes");
        let threads = loaded.saturating_sub(before);
        let processes = processes_loaded.saturating_sub(processes_before);
        let found = format!("{threads} more threads, {processes} more processes");
        return broken(finding.with(found, "none before an instance is created"));
    }
    evaluate(bench, &library, 20)?;
    let settled = || {
        let end = Instant::now() + PATIENCE;
        while (count_threads() > before || processes() > processes_before) && Instant::now() < end {
            std::thread::sleep(Duration::from_millis(2));
        }
        (count_threads().saturating_sub(before), processes().saturating_sub(processes_before))
    };
    let (threads, left) = settled();
    if left > 0 {
        let finding = Finding::new("processes are left when the instance is destroyed");
        return broken(finding.with(format!("{left} more"), "as many as before"));
    }
    if threads == 0 {
        return Ok(Verdict::Pass(None));
    }
    // Threads of the library itself have to end with it.
    bench.label("the library unloaded while threads of it run");
    library.close();
    let (left, _) = settled();
    if left == 0 {
        // One that runs on in code that is gone would crash about now.
        std::thread::sleep(Duration::from_millis(5));
        return Ok(Verdict::Pass(None));
    }
    let needed = FileFacts::examine(path).map(|facts| facts.elf.needed).unwrap_or_default();
    if needed.iter().any(|library| KEEPING.iter().any(|name| library.starts_with(name))) {
        return Ok(Verdict::Pass(Some(format!("{left} threads are kept by the OpenMP runtime"))));
    }
    let finding = Finding::new("threads are left when the instance is destroyed and the library unloaded");
    broken(finding.with(format!("{left} more"), "as many as before"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn this_program_names_its_dynamic_linker() {
        let linker = interpreter().expect("tests are linked dynamically");
        assert!(linker.starts_with('/') && std::path::Path::new(&linker).exists(), "{linker}");
    }
}
