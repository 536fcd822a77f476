//! ELF headers, read the way the dynamic linker reads them: through the segments, not the sections.

use std::path::Path;

use object::elf;
use object::endian::LittleEndian;
use object::pod;
use object::read::elf::{Dyn, FileHeader, GnuHashTable, HashTable, ProgramHeader, Sym};

use super::{ENTRY_SYMBOL, FileFactsError, LAYOUT_SYMBOL, LookAlike, MAJOR_VERSION};

/// What the headers of a shared library say.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ElfFacts {
    /// The processor, as one says it: `x86-64`, `aarch64`.
    pub architecture: String,
    /// 32 or 64.
    pub bits: u8,
    /// The operating system it names: `System V` (any) or `GNU/Linux`.
    pub os_abi: String,
    /// Whether it exports the function [`ENTRY_SYMBOL`].
    pub has_entry: bool,
    /// Major versions other than this host's that it has an entry for, ascending.
    pub other_majors: Vec<u32>,
    /// An export that was probably meant to be the entry: a C++ or Fortran name, or data of that name.
    pub near_miss: Option<String>,
    /// Whether it exports [`LAYOUT_SYMBOL`].
    pub has_layout: bool,
    /// Number of symbols it exports.
    pub exported_symbols: usize,
    /// Libraries it needs (DT_NEEDED), in its order.
    pub needed: Vec<String>,
    /// Its own name (DT_SONAME).
    pub soname: Option<String>,
    /// DT_RPATH, folder by folder, `$ORIGIN` not yet replaced.
    pub rpath: Vec<String>,
    /// DT_RUNPATH, folder by folder, `$ORIGIN` not yet replaced.
    pub runpath: Vec<String>,
    /// Symbols that others must define, weak ones left out.
    pub undefined: Vec<String>,
}

type Header = elf::FileHeader64<LittleEndian>;

/// The host's own architecture, as [`ElfFacts::architecture`] says it.
pub(super) const HOST_ARCHITECTURE: &str = if cfg!(target_arch = "x86_64") {
    "x86-64"
} else if cfg!(target_arch = "aarch64") {
    "aarch64"
} else {
    std::env::consts::ARCH
};

impl ElfFacts {
    /// Reads the facts from the whole file's bytes, which start with the ELF magic.
    pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Self, FileFactsError> {
        let path_buf = || path.to_path_buf();
        let found = bytes.len() as u64;
        let truncated = |expected: u64| FileFactsError::Truncated { path: path_buf(), found, expected };
        let damaged = |what| FileFactsError::Damaged { path: path_buf(), what };
        // Identification and machine stand at the same place in every class.
        if found < 20 {
            return Err(truncated(64));
        }
        let architecture = architecture(bytes);
        if architecture != HOST_ARCHITECTURE {
            return Err(FileFactsError::OtherArchitecture {
                path: path_buf(),
                found: architecture,
                expected: HOST_ARCHITECTURE,
            });
        }
        if found < 64 {
            return Err(truncated(64));
        }
        let os_abi = os_abi_name(bytes[7]);
        // glibc takes these two and refuses the rest.
        if !matches!(bytes[7], 0 | 3) {
            return Err(FileFactsError::OtherSystem { path: path_buf(), found: os_abi });
        }
        let header = Header::parse(bytes).map_err(|_| damaged("its ELF header is not of a known version"))?;
        let endian = LittleEndian;
        let expected = described_size(header, bytes);
        let e_type = header.e_type(endian);
        let not_a_library = |found| FileFactsError::NotALibrary { path: path_buf(), found };
        if e_type == elf::ET_REL {
            return Err(not_a_library(LookAlike::ObjectFile));
        } else if e_type == elf::ET_EXEC {
            return Err(not_a_library(LookAlike::Executable));
        } else if e_type == elf::ET_CORE {
            return Err(not_a_library(LookAlike::CoreDump));
        } else if e_type != elf::ET_DYN {
            return Err(not_a_library(LookAlike::Unknown));
        }
        if found < expected {
            return Err(truncated(expected));
        }
        let dynamic = Dynamic::find(header, bytes).map_err(damaged)?;
        if dynamic.is_program() {
            return Err(not_a_library(LookAlike::Executable));
        }
        let mut facts = Self {
            architecture,
            bits: 64,
            os_abi,
            has_entry: false,
            other_majors: Vec::new(),
            near_miss: None,
            has_layout: false,
            exported_symbols: 0,
            needed: dynamic.strings_of(elf::DT_NEEDED),
            soname: dynamic.strings_of(elf::DT_SONAME).pop(),
            rpath: split_folders(dynamic.strings_of(elf::DT_RPATH)),
            runpath: split_folders(dynamic.strings_of(elf::DT_RUNPATH)),
            undefined: Vec::new(),
        };
        for symbol in dynamic.symbols().map_err(damaged)? {
            facts.note_symbol(symbol, &dynamic.string(symbol.st_name(endian).into()));
        }
        facts.other_majors.sort_unstable();
        facts.other_majors.dedup();
        Ok(facts)
    }

    fn note_symbol(&mut self, symbol: &elf::Sym64<LittleEndian>, name: &str) {
        if name.is_empty() || symbol.is_local() {
            return;
        }
        if symbol.is_undefined(LittleEndian) {
            if !symbol.is_weak() {
                self.undefined.push(name.to_owned());
            }
            return;
        }
        self.exported_symbols += 1;
        let kind = symbol.st_type();
        let is_code = kind == elf::STT_FUNC || kind == elf::STT_GNU_IFUNC || kind == elf::STT_NOTYPE;
        if name == LAYOUT_SYMBOL {
            self.has_layout = true;
        } else if name == ENTRY_SYMBOL && is_code {
            self.has_entry = true;
        } else if let Some(major) = name.strip_prefix("wearlaw_entry_").and_then(|n| n.parse().ok()) {
            if major == MAJOR_VERSION {
                self.near_miss = Some(name.to_owned());
            } else {
                self.other_majors.push(major);
            }
        } else if name.to_ascii_lowercase().contains("wearlaw_entry") {
            self.near_miss = Some(name.to_owned());
        }
    }
}

/// The dynamic segment: what the linker reads, found through the program headers.
struct Dynamic<'a> {
    header: &'a Header,
    bytes: &'a [u8],
    entries: &'a [elf::Dyn64<LittleEndian>],
    strings: &'a [u8],
}

impl<'a> Dynamic<'a> {
    fn find(header: &'a Header, bytes: &'a [u8]) -> Result<Self, &'static str> {
        let segments = header.program_headers(LittleEndian, bytes).map_err(|_| "its program headers are unreadable")?;
        let entries = segments
            .iter()
            .find_map(|segment| segment.dynamic(LittleEndian, bytes).transpose())
            .ok_or("it has no dynamic segment")?
            .map_err(|_| "its dynamic segment lies outside the file")?;
        let mut dynamic = Self { header, bytes, entries, strings: &[] };
        let strings = dynamic.value(elf::DT_STRTAB).and_then(|address| dynamic.at_address(address));
        let strings = strings.ok_or("its dynamic string table lies outside the file")?;
        let size = dynamic.value(elf::DT_STRSZ).and_then(|size| usize::try_from(size).ok()).unwrap_or(strings.len());
        dynamic.strings = strings.get(..size).ok_or("its dynamic string table lies outside the file")?;
        Ok(dynamic)
    }

    fn iter(&self) -> impl Iterator<Item = (elf::DynamicTag, u64)> + '_ {
        let pairs = self.entries.iter().map(|entry| (entry.tag(LittleEndian), entry.val(LittleEndian)));
        pairs.take_while(|(tag, _)| *tag != elf::DT_NULL)
    }

    fn value(&self, wanted: elf::DynamicTag) -> Option<u64> {
        self.iter().find(|(tag, _)| *tag == wanted).map(|(_, value)| value)
    }

    fn strings_of(&self, wanted: elf::DynamicTag) -> Vec<String> {
        self.iter().filter(|(tag, _)| *tag == wanted).map(|(_, value)| self.string(value)).collect()
    }

    fn string(&self, offset: u64) -> String {
        let rest = usize::try_from(offset).ok().and_then(|offset| self.strings.get(offset..)).unwrap_or(&[]);
        let text = rest.split(|&byte| byte == 0).next().unwrap_or(&[]);
        String::from_utf8_lossy(text).into_owned()
    }

    /// The linker refuses to load what is marked as a position-independent program.
    fn is_program(&self) -> bool {
        const DF_1_PIE: u64 = 0x0800_0000;
        self.value(elf::DT_FLAGS_1).is_some_and(|flags| flags & DF_1_PIE != 0)
    }

    /// The file's bytes from a virtual address to the end of the segment that holds it.
    fn at_address(&self, address: u64) -> Option<&'a [u8]> {
        let segments = self.header.program_headers(LittleEndian, self.bytes).ok()?;
        segments.iter().filter(|segment| segment.p_type(LittleEndian) == elf::PT_LOAD).find_map(|segment| {
            let skip = address.checked_sub(segment.p_vaddr(LittleEndian))?;
            segment.data(LittleEndian, self.bytes).ok()?.get(usize::try_from(skip).ok()?..)
        })
    }

    fn symbols(&self) -> Result<&'a [elf::Sym64<LittleEndian>], &'static str> {
        const WHAT: &str = "its dynamic symbol table cannot be followed";
        let Some(table) = self.value(elf::DT_SYMTAB) else {
            return Ok(&[]);
        };
        let at = |tag| self.value(tag).and_then(|address| self.at_address(address));
        // The table does not say how long it is; the hash tables over it do.
        let count = if let Some(data) = at(elf::DT_HASH) {
            HashTable::<Header>::parse(LittleEndian, data).map_err(|_| WHAT)?.symbol_table_length()
        } else if let Some(data) = at(elf::DT_GNU_HASH) {
            let hash = GnuHashTable::<Header>::parse(LittleEndian, data).map_err(|_| WHAT)?;
            // Without any export the hashed part is empty: what lies before it are the undefined symbols.
            hash.symbol_table_length(LittleEndian).unwrap_or_else(|| hash.symbol_base())
        } else {
            return Err(WHAT);
        };
        let data = self.at_address(table).ok_or(WHAT)?;
        let count = usize::try_from(count).map_err(|_| WHAT)?;
        pod::slice_from_bytes(data, count).map(|(symbols, _)| symbols).map_err(|()| WHAT)
    }
}

/// The bytes that the headers account for: both header tables and every segment.
fn described_size(header: &Header, bytes: &[u8]) -> u64 {
    let table = |offset: u64, count: u16, size: u16| offset.saturating_add(u64::from(count) * u64::from(size));
    let endian = LittleEndian;
    let mut size = table(header.e_phoff(endian), header.e_phnum(endian), header.e_phentsize(endian));
    if header.e_shoff(endian) != 0 {
        // The section headers are the last thing in a file: a cut of any length shows here.
        size = size.max(table(header.e_shoff(endian), header.e_shnum(endian), header.e_shentsize(endian)));
    }
    for segment in header.program_headers(endian, bytes).unwrap_or(&[]) {
        let (offset, length) = segment.file_range(endian);
        size = size.max(offset.saturating_add(length));
    }
    size
}

/// Names processor, word size and byte order where they are not the usual ones; `bytes` has 20 or more.
fn architecture(bytes: &[u8]) -> String {
    let (wide, little) = (bytes[4] == 2, bytes[5] != 2);
    let machine = [bytes[18], bytes[19]];
    let machine = if little { u16::from_le_bytes(machine) } else { u16::from_be_bytes(machine) };
    let (name, usual_bits_64) = match elf::Machine(machine) {
        elf::EM_X86_64 => ("x86-64", true),
        elf::EM_AARCH64 => ("aarch64", true),
        elf::EM_386 => ("x86", false),
        elf::EM_ARM => ("arm", false),
        elf::EM_RISCV => ("risc-v", true),
        elf::EM_PPC64 => ("powerpc64", true),
        elf::EM_PPC => ("powerpc", false),
        elf::EM_S390 => ("s390x", true),
        elf::EM_MIPS => ("mips", false),
        elf::EM_SPARCV9 => ("sparc64", true),
        elf::EM_LOONGARCH => ("loongarch64", true),
        _ => return format!("a processor of ELF number {machine}"),
    };
    let usual_little = !matches!(name, "powerpc" | "s390x" | "sparc64");
    let mut words = String::new();
    if wide != usual_bits_64 || !wide {
        words += if wide { "64-bit " } else { "32-bit " };
    }
    if little != usual_little {
        words += if little { "little-endian " } else { "big-endian " };
    }
    words + name
}

fn os_abi_name(value: u8) -> String {
    match value {
        0 => "System V".into(),
        2 => "NetBSD".into(),
        3 => "GNU/Linux".into(),
        6 => "Solaris".into(),
        9 => "FreeBSD".into(),
        12 => "OpenBSD".into(),
        other => format!("a system of ELF number {other}"),
    }
}

fn split_folders(lists: Vec<String>) -> Vec<String> {
    lists.iter().flat_map(|list| list.split(':')).filter(|folder| !folder.is_empty()).map(str::to_owned).collect()
}
