//! Copies of constant size in a WebAssembly module, as loads and stores.
//!
//! The compiler moves what is larger than 64 bytes by `memory.copy`, for which engines call a function: V8
//! takes 10 ns for 88 bytes, and 2.5 ns to load and store them. Curves are made of such pieces.

use std::fs;
use std::path::Path;

use walrus::ir::{
    Const, Instr, InstrLocId, InstrSeq, Load, LoadKind, LocalGet, LocalSet, MemArg, MemoryCopy,
    Store, StoreKind, Value, VisitorMut, dfs_pre_order_mut,
};
use walrus::{LocalId, Module, ModuleConfig, ModuleLocals, ValType};

/// Bytes up to which a copy may be spelled out; beyond, the call costs less than the code.
const MOST: usize = 128;

/// Spells out the module's copies of up to so many bytes, at most [`MOST`].
pub(crate) fn spell_out(file: &Path, most: usize) -> Result<(), String> {
    let wrong = |error: &dyn std::fmt::Display| format!("{}: {error}", file.display());
    let bytes = fs::read(file).map_err(|error| wrong(&error))?;
    let mut config = ModuleConfig::new();
    config.generate_name_section(false).generate_producers_section(false);
    let mut module: Module = config.parse(&bytes).map_err(|error| wrong(&error))?;
    for (_, function) in module.funcs.iter_local_mut() {
        let entry = function.entry_block();
        let mut copies = Copies { locals: &mut module.locals, room: None, most: most.min(MOST) };
        dfs_pre_order_mut(&mut copies, function, entry);
    }
    fs::write(file, module.emit_wasm()).map_err(|error| wrong(&error))
}

/// Spells out the copies of a function.
struct Copies<'a> {
    locals: &'a mut ModuleLocals,
    room: Option<Room>,
    most: usize,
}

/// The function's locals for what is copied.
struct Room {
    target: LocalId,
    source: LocalId,
    /// By how many words of 16 bytes come before.
    words: [LocalId; MOST / 16],
    half: LocalId,
    quarter: LocalId,
}

impl Room {
    fn new(locals: &mut ModuleLocals) -> Room {
        Room {
            target: locals.add(ValType::I32),
            source: locals.add(ValType::I32),
            words: std::array::from_fn(|_| locals.add(ValType::V128)),
            half: locals.add(ValType::I64),
            quarter: locals.add(ValType::I32),
        }
    }

    /// All is loaded before anything is stored, so that the two may overlap.
    fn copy(&self, MemoryCopy { src, dst }: MemoryCopy, size: usize) -> Vec<Instr> {
        let whole =
            (0..size / 16).map(|i| (16 * i, self.words[i], LoadKind::V128, StoreKind::V128));
        let half = (size % 16 >= 8).then_some((
            size / 16 * 16,
            self.half,
            LoadKind::I64 { atomic: false },
            StoreKind::I64 { atomic: false },
        ));
        let quarter = (size % 8 == 4).then_some((
            size / 8 * 8,
            self.quarter,
            LoadKind::I32 { atomic: false },
            StoreKind::I32 { atomic: false },
        ));
        let parts: Vec<_> = whole.chain(half).chain(quarter).collect();
        let get = |local| Instr::LocalGet(LocalGet { local });
        let set = |local| Instr::LocalSet(LocalSet { local });
        let mut code = vec![set(self.source), set(self.target)];
        for &(offset, local, kind, _) in &parts {
            let arg = MemArg { align: 4, offset: offset as u64 };
            code.extend([
                get(self.source),
                Instr::Load(Load { memory: src, kind, arg }),
                set(local),
            ]);
        }
        for &(offset, local, _, kind) in &parts {
            let arg = MemArg { align: 4, offset: offset as u64 };
            let store = Instr::Store(Store { memory: dst, kind, arg });
            code.extend([get(self.target), get(local), store]);
        }
        code
    }
}

impl VisitorMut for Copies<'_> {
    fn start_instr_seq_mut(&mut self, sequence: &mut InstrSeq) {
        let mut code: Vec<(Instr, InstrLocId)> = Vec::with_capacity(sequence.instrs.len());
        for (instruction, place) in sequence.instrs.drain(..) {
            let size = match (&instruction, code.last()) {
                (
                    Instr::MemoryCopy(_),
                    Some((Instr::Const(Const { value: Value::I32(size) }), _)),
                ) => usize::try_from(*size).ok().filter(|size| *size <= self.most && size % 4 == 0),
                _ => None,
            };
            match (instruction, size) {
                (Instr::MemoryCopy(copy), Some(size)) => {
                    code.pop();
                    let room = self.room.get_or_insert_with(|| Room::new(self.locals));
                    code.extend(room.copy(copy, size).into_iter().map(|part| (part, place)));
                }
                (instruction, _) => code.push((instruction, place)),
            }
        }
        sequence.instrs = code;
    }
}
