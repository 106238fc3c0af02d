//! Any list with an end mark, any flags and any missing callbacks: the answer is 0 and nothing is called, or 1
//! and everything that is handed over is finite, in order, and ends where it should. Run with a sanitizer.
#![no_main]

use std::ffi::{c_char, c_int};
use std::ptr::{null, null_mut};

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use spiro::abi::{BezCtx, SpiroCp};

#[derive(Arbitrary, Debug)]
struct Input {
    points: Vec<(Number, Number, u8)>,
    ncq: u16,
    entry: u8,
    missing: u8,
    /// A count or a capacity.
    count: i8,
}

#[derive(Arbitrary, Debug)]
enum Number {
    Whole(i16),
    Small(i8, u8),
    Any(f64),
}

impl Number {
    fn value(&self) -> f64 {
        match *self {
            Number::Whole(n) => f64::from(n),
            Number::Small(n, part) => f64::from(n) + f64::from(part) / 256.0,
            Number::Any(x) => x,
        }
    }
}

#[repr(C)]
struct Receiver {
    base: BezCtx,
    calls: usize,
    next_knot: c_int,
}

unsafe fn see(context: *mut BezCtx, numbers: &[f64]) {
    assert!(numbers.iter().all(|number| number.is_finite()), "{numbers:?}");
    unsafe { (*context.cast::<Receiver>()).calls += 1 };
}

unsafe extern "C" fn moveto(context: *mut BezCtx, x: f64, y: f64, open: c_int) {
    assert!(open == 0 || open == 1);
    unsafe { see(context, &[x, y]) };
}

unsafe extern "C" fn lineto(context: *mut BezCtx, x: f64, y: f64) {
    unsafe { see(context, &[x, y]) };
}

unsafe extern "C" fn quadto(context: *mut BezCtx, a: f64, b: f64, x: f64, y: f64) {
    unsafe { see(context, &[a, b, x, y]) };
}

unsafe extern "C" fn curveto(
    context: *mut BezCtx,
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    x: f64,
    y: f64,
) {
    unsafe { see(context, &[a, b, c, d, x, y]) };
}

unsafe extern "C" fn mark_knot(context: *mut BezCtx, knot: c_int) {
    unsafe {
        see(context, &[]);
        let receiver = &mut *context.cast::<Receiver>();
        assert_eq!(knot, receiver.next_knot);
        receiver.next_knot += 1;
    }
}

impl Receiver {
    fn new(missing: u8) -> Receiver {
        let has = |bit: u8| missing & 1 << bit == 0;
        Receiver {
            base: BezCtx {
                moveto: has(0).then_some(moveto),
                lineto: has(1).then_some(lineto),
                quadto: has(2).then_some(quadto),
                curveto: has(3).then_some(curveto),
                mark_knot: has(4).then_some(mark_knot),
            },
            calls: 0,
            next_knot: 0,
        }
    }
}

fuzz_target!(|input: Input| {
    const FEW: usize = 14;
    const INTERNAL: c_int = 0x0200;
    let letters = b"voc[]ahxvoc{}z";
    let mut list: Vec<SpiroCp> = input
        .points
        .iter()
        .take(FEW)
        .map(|(x, y, letter)| SpiroCp {
            x: x.value(),
            y: y.value(),
            ty: *letters.get(usize::from(*letter)).unwrap_or(letter) as c_char,
        })
        .collect();
    let ncq = c_int::from(input.ncq) & !INTERNAL;
    let mut receiver = Receiver::new(input.missing);
    let bc: *mut BezCtx = (&raw mut receiver).cast();
    let n = list.len() as c_int;
    let mark = if list.first().is_some_and(|first| first.ty == b'{' as c_char) { b'}' } else { b'z' };
    let marked = |list: &mut Vec<SpiroCp>| {
        list.push(SpiroCp { x: 1.0, y: f64::NAN, ty: mark as c_char });
        if mark == b'}' {
            list.last_mut().unwrap().y = 2.0;
        }
    };
    // SAFETY: lists are marked or counted as each function asks; what is freed is freed once.
    unsafe {
        let mut done = None;
        match input.entry % 6 {
            0 => {
                marked(&mut list);
                done = Some(spiro::TaggedSpiroCPsToBezier2(list.as_mut_ptr(), ncq, bc));
            }
            1 => {
                let n = n.min(c_int::from(input.count).max(n));
                let closed = c_int::from(input.missing >> 5 & 1);
                done = Some(spiro::SpiroCPsToBezier2(list.as_mut_ptr(), n, ncq, closed, bc));
            }
            2 | 3 => {
                marked(&mut list);
                let (mut dm, n) = ([0.0; 3], list.len() as c_int);
                let s = spiro::run_spiro0(list.as_ptr(), dm.as_mut_ptr(), ncq, n);
                if !s.is_null() {
                    for i in 0..=n {
                        assert!(spiro::get_knot_th(s, i).is_finite());
                    }
                    let (src, n) = match input.entry % 6 {
                        2 => (list.as_ptr(), n),
                        _ => (null(), n.min(c_int::from(input.count).max(1))),
                    };
                    spiro::spiro_to_bpath0(src, s, dm.as_mut_ptr(), ncq, n, bc);
                    spiro::free_spiro(s);
                }
            }
            4 => {
                marked(&mut list);
                let flags = ncq | INTERNAL;
                let kept = spiro::new_ls_bezctx(c_int::from(input.count), flags);
                assert_eq!(kept.is_null(), input.count <= 0);
                if !kept.is_null() {
                    spiro::TaggedSpiroCPsToBezier2(list.as_mut_ptr(), flags, kept.cast());
                    spiro::TaggedSpiroCPsToBezier2(list.as_mut_ptr(), flags, kept.cast());
                    assert!(((*kept).l..=(*kept).max).contains(&(*kept).l) && (*kept).l >= -1);
                    for i in 0..(*kept).l.max(0) {
                        let entry = &*(*kept).cd.add(i as usize);
                        assert!(entry.points.iter().flatten().all(|number| number.is_finite()));
                    }
                }
                spiro::free_ls_bezctx(kept);
            }
            _ => {
                let before = list.clone();
                assert_eq!(spiro::spiroreverse(list.as_mut_ptr(), n), if n > 0 { 0 } else { -1 });
                assert_eq!(list.len(), before.len());
                spiro::free_spiro(spiro::run_spiro(list.as_ptr(), n));
                spiro::SpiroCPsToBezier(null_mut(), n, 1, bc);
                done = Some(0);
            }
        }
        if let Some(done) = done {
            assert!(done == 1 || done == 0 && receiver.calls == 0);
        }
    }
});
