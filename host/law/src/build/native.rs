//! C, C++ and Fortran sources to a library.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::adapt::Adaptation;
use super::command::Log;
use super::{Aside, BuildError, BuildRequest, Language, headers, library_file_name};

/// For every compile: no fused multiply-add that only some machines have, exports as the source says, and no promises
/// about `errno` and traps, which would keep gcc from vectorising a law that has a branch.
const COMPILE_FLAGS: [&str; 4] = ["-ffp-contract=off", "-fvisibility=default", "-fno-math-errno", "-fno-trapping-math"];

/// For Fortran: without the first, gfortran takes the vector library's `pow` in full vectors and the scalar one in what
/// is left over, so that bits depend on the batch. The second is for the many arguments that one form of procedure has, the
/// last because all else follows from the first few errors, as in the helper when a declaration is wrong.
const FORTRAN_FLAGS: [&str; 3] = ["-nostdinc", "-Wno-unused-dummy-argument", "-fmax-errors=3"];

/// Compiles each source with its language's compiler and links the objects.
pub(super) fn build(request: &BuildRequest, sources: &[(PathBuf, Language)]) -> Result<(PathBuf, Log), BuildError> {
    let output = request.output.clone().unwrap_or_else(|| default_output(&sources[0].0));
    let layer = request.adaptation.as_ref().map(|adaptation| layer(adaptation, &sources[0])).transpose()?;
    let aside = Aside::new(&output)?;
    let temporary = tempfile::Builder::new().prefix("wearlaw-build-").tempdir();
    let temporary = temporary.map_err(|source| BuildError::TemporaryFiles { path: std::env::temp_dir(), source })?;
    let work = temporary.path();
    headers::write_into(&work.join("include"))
        .map_err(|source| BuildError::TemporaryFiles { path: work.to_path_buf(), source })?;

    let has = |language| sources.iter().any(|(_, other)| *other == language);
    let toolchain = Toolchain { request, work };
    let mut log = Log::default();
    let mut objects = Vec::new();
    if has(Language::Fortran) {
        // The module has to be compiled before the sources that use it.
        for (name, _) in headers::CARRIED.iter().filter(|(name, _)| name.ends_with(".f90")) {
            let source = work.join("include").join(name);
            objects.push(toolchain.compile(&mut log, &source, Language::Fortran, objects.len())?);
        }
    }
    for (source, language) in sources {
        objects.push(toolchain.compile(&mut log, source, *language, objects.len())?);
    }
    if let Some(layer) = layer {
        let source = work.join("layer.c");
        std::fs::write(&source, layer)
            .map_err(|source| BuildError::TemporaryFiles { path: work.to_path_buf(), source })?;
        objects.push(toolchain.compile(&mut log, &source, Language::C, objects.len())?);
    }
    let driver = [Language::Fortran, Language::Cpp].into_iter().find(|&l| has(l)).unwrap_or(Language::C);
    let mut link = toolchain.driver(driver)?;
    link.arg("-shared").arg("-o").arg(aside.library()).args(&objects);
    if driver == Language::Fortran && has(Language::Cpp) {
        link.arg("-lstdc++");
    }
    // A sanitizer's runtime is left undefined on purpose by clang.
    let sanitized = request.extra_flags.iter().any(|flag| flag.to_string_lossy().starts_with("-fsanitize"));
    if cfg!(target_os = "linux") && !sanitized {
        // A missing symbol is better found here than by whoever loads the law.
        link.arg("-Wl,--no-undefined");
    }
    link.arg("-lm").args(&request.extra_flags);
    log.run(link, driver)?;
    Ok((aside.finish()?, log))
}

/// The layer around the subroutine in a source; the law has the source's name.
fn layer(adaptation: &Adaptation, (source, language): &(PathBuf, Language)) -> Result<String, BuildError> {
    if *language != Language::Fortran {
        let what = format!("found {language} by its ending, expected Fortran");
        return Err(BuildError::NoSubroutine { path: source.clone(), what });
    }
    let bytes =
        std::fs::read(source).map_err(|error| BuildError::SourceUnreadable { path: source.clone(), source: error })?;
    let name = source.file_stem().map(|stem| stem.to_string_lossy().to_lowercase()).unwrap_or_default();
    let name: String = name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' }).collect();
    adaptation.layer(source, &String::from_utf8_lossy(&bytes), &name)
}

struct Toolchain<'a> {
    request: &'a BuildRequest,
    work: &'a Path,
}

impl Toolchain<'_> {
    /// Compiles one source to an object in the temporary folder.
    fn compile(&self, log: &mut Log, source: &Path, language: Language, index: usize) -> Result<PathBuf, BuildError> {
        let object = self.work.join(format!("{index}.o"));
        let mut command = self.driver(language)?;
        command.args(COMPILE_FLAGS);
        for folder in &self.request.include_dirs {
            command.arg("-I").arg(not_a_flag(folder));
        }
        command.arg("-I").arg(self.work.join("include"));
        if language == Language::Fortran {
            command.arg("-J").arg(self.work).args(FORTRAN_FLAGS);
        }
        command.args(&self.request.extra_flags);
        command.arg("-c").arg(not_a_flag(source)).arg("-o").arg(&object);
        log.run(command, language)?;
        Ok(object)
    }

    /// The language's compiler with the flags that compiling and linking share.
    fn driver(&self, language: Language) -> Result<Command, BuildError> {
        if language == Language::Fortran {
            let named = self.request.compilers.fortran.clone().or_else(|| from_environment("FC"));
            let mut command = command_of(&named.unwrap_or_else(|| "gfortran".into()));
            command.args(["-O3", "-fPIC", "-Wall"]);
            if let Some(flags) = from_environment("FFLAGS") {
                command.args(flags.to_string_lossy().split_whitespace());
            }
            return Ok(command);
        }
        let target = env!("WEARLAW_TARGET");
        let mut build = cc::Build::new();
        // Nothing of this is known outside of a build script, so everything is said.
        build.target(target).host(target).opt_level(3).pic(true).debug(false).cpp(language == Language::Cpp);
        build.cargo_metadata(false).cargo_warnings(false).cargo_output(false);
        build.warnings(true).extra_warnings(false).out_dir(self.work);
        let named = match language {
            Language::Cpp => &self.request.compilers.cpp,
            _ => &self.request.compilers.c,
        };
        let mut own_flags = Vec::new();
        if let Some(named) = named {
            let command = command_of(named);
            own_flags = command.get_args().map(OsString::from).collect();
            build.compiler(command.get_program());
        }
        let tool = build.try_get_compiler().map_err(|source| BuildError::Unusable { language, source })?;
        let mut command = tool.to_command();
        command.args(own_flags);
        Ok(command)
    }
}

/// A command with flags behind blanks, as `$CC` and its kin hold them.
fn command_of(line: &OsString) -> Command {
    if Path::new(line).exists() {
        return Command::new(line);
    }
    let line = line.to_string_lossy();
    let mut words = line.split_whitespace();
    let mut command = Command::new(words.next().unwrap_or_default());
    command.args(words);
    command
}

fn from_environment(name: &str) -> Option<OsString> {
    std::env::var_os(name).filter(|value| !value.is_empty())
}

/// A path that no compiler takes for a flag.
fn not_a_flag(path: &Path) -> PathBuf {
    if path.to_string_lossy().starts_with('-') { Path::new(".").join(path) } else { path.to_path_buf() }
}

fn default_output(source: &Path) -> PathBuf {
    let stem = source.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    PathBuf::from(library_file_name(&stem))
}
