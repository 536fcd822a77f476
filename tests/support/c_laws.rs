//! Small laws in C, compiled by the tests against `include/wearlaw.h`.
#![allow(dead_code)] // reason: each test file uses a part of it.

use std::path::{Path, PathBuf};
use std::process::Command;

use wearlaw::law::{Batch, EvaluateError, Evaluation, Evaluator, Field, Outputs, Values};

/// Everything of a law but what happens at a point, in `at_point`, and in the hooks that a source may define.
const BEFORE: &str = r#"
#include "wearlaw.h"
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifndef READS
#define READS (WL_FIELD_PRESSURE | WL_FIELD_SLIP)
#endif
#ifndef CLAIMS
#define CLAIMS 0
#endif
#ifndef WRITES
#define WRITES (WL_OUT_DIRECTION | WL_OUT_STATUS)
#endif
#ifndef LAWS
#define LAWS 1
#endif
static double at(wl_column c, int64_t i) { return c.ptr[i * c.step]; }
static void say(char *to, int64_t size, const char *text) {
  if (to && size > 0) { strncpy(to, text, (size_t)size - 1); to[size - 1] = 0; }
}
static void note(const char *text) {
  FILE *file = getenv("WEARLAW_TEST_NOTES") ? fopen(getenv("WEARLAW_TEST_NOTES"), "a") : NULL;
  if (file) { fputs(text, file); fclose(file); }
}
"#;

const AFTER: &str = r#"
static int32_t describe(int32_t kind, int64_t index, wl_quantity *quantity) {
  wl_quantity mine;
  int64_t size = quantity->struct_size < (int64_t)sizeof mine ? quantity->struct_size : (int64_t)sizeof mine;
  memcpy(&mine, quantity, (size_t)size);
  if (kind == WL_KIND_FIELD && index == 41) strcpy(mine.name, "humidity");
  else if (kind == WL_KIND_CONSTANT && index == 0) {
    strcpy(mine.name, "K");
    mine.minimum = 0;
    mine.default_value = 1e-4;
  } else return WL_NO_MORE;
  memcpy(quantity, &mine, (size_t)size);
  return WL_OK;
}
static int32_t evaluate(void *instance, const wl_view *view, wl_output *output) {
  int32_t worst = WL_OK;
  (void)instance;
  for (int64_t i = 0; i < view->points; i++) {
    int32_t status;
    output->increment[i] = at(view->constants[0], i) * at(view->pressure, i) * at(view->slip, i);
    if (output->direction) {
      output->direction[3 * i] = 0; output->direction[3 * i + 1] = 0; output->direction[3 * i + 2] = -1;
    }
    status = at_point(view, output, i, at(view->pressure, i));
    if (output->status) output->status[i] = status;
    if (status > worst) { worst = status; say(output->text, output->text_size, "too much"); }
  }
  return worst;
}
static int32_t create(const wl_host *host, const char *options, void **instance, char *text, int64_t text_size) {
  (void)host;
  if (options && !strcmp(options, "refuse")) { say(text, text_size, "the table wear.dat is not there"); return WL_FAILED; }
  if (options && !strcmp(options, "crash")) abort();
  *instance = malloc(8);
  note("create\n");
  return WL_OK;
}
static void destroy(void *instance) { free(instance); note("destroy\n"); }
__attribute__((constructor)) static void opened(void) { note("open\n"); }
__attribute__((destructor)) static void closed(void) { note("close\n"); }
int32_t wearlaw_entry_1(int32_t index, const wl_host *host, wl_law *law) {
  wl_law mine;
  int64_t size = law->struct_size < (int64_t)sizeof mine ? law->struct_size : (int64_t)sizeof mine;
  (void)host;
  if (index >= LAWS) return WL_NO_MORE;
  memcpy(&mine, law, (size_t)size);
  sprintf(mine.name, index ? "law-%d" : "small", (int)index);
  strcpy(mine.version, "1");
  mine.abi_minor = WL_ABI_MINOR;
  mine.reads = READS;
  mine.writes = WRITES;
  mine.claims = CLAIMS;
  mine.constant_count = 1;
  mine.describe = describe;
  mine.create = create;
  mine.evaluate = evaluate;
  mine.destroy = destroy;
  memcpy(law, &mine, (size_t)size);
  return WL_OK;
}
"#;

/// A folder with a compiled law in it, gone with this value.
pub struct CLaw {
    folder: tempfile::TempDir,
}

impl CLaw {
    /// A law whose points answer with the C statements `at_point` (`i`, `p`, `view`, `output`; `return` a status).
    pub fn new(at_point: &str) -> Self {
        Self::with("", at_point)
    }

    /// As [`CLaw::new`], with C text in front of everything.
    pub fn with(front: &str, at_point: &str) -> Self {
        Self::edited(front, at_point, |header| header)
    }

    /// As [`CLaw::with`], against a changed header.
    pub fn edited(front: &str, at_point: &str, edit: impl Fn(String) -> String) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let header = Path::new(env!("CARGO_MANIFEST_DIR")).join("../include/wearlaw.h");
        let header = edit(std::fs::read_to_string(header).expect("the header is committed"));
        std::fs::write(folder.path().join("wearlaw.h"), header).expect("the folder can be written");
        let source = format!(
            "{front}{BEFORE}static int32_t at_point(const wl_view *view, wl_output *output, int64_t i, double p) {{\n  \
             (void)view; (void)output; (void)i; (void)p;\n  {at_point}\n  return WL_OK;\n}}\n{AFTER}"
        );
        std::fs::write(folder.path().join("law.c"), source).expect("the folder can be written");
        let law = Self { folder };
        let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
        let status = Command::new(compiler)
            .current_dir(law.folder.path())
            .args(["-O1", "-fPIC", "-shared", "-o", "small.so", "law.c", "-lm"])
            .status()
            .expect("a C compiler");
        assert!(status.success(), "the law does not compile");
        law
    }

    /// The library.
    pub fn path(&self) -> PathBuf {
        self.folder.path().join("small.so")
    }

    /// A file in the same folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }
}

/// Evaluates a law at so many points with pressures 1, 2, .., slip 0.5 and K = 2; gives the increments.
pub fn evaluate(law: &dyn Evaluator, points: usize) -> (Result<Evaluation, EvaluateError>, Vec<f64>) {
    let pressure: Vec<f64> = (0..points).map(|point| 1.0 + point as f64).collect();
    let batch = Batch::builder(law.descriptor(), points)
        .field(Field::Pressure, Values::PerPoint(&pressure))
        .field(Field::Slip, Values::Uniform(0.5))
        .constants(&[2.0])
        .build()
        .expect("every column fits");
    let (mut increment, mut direction) = (vec![0.0; points], vec![0.0; 3 * points]);
    let mut outputs = Outputs { direction: Some(&mut direction), ..Outputs::new(&mut increment) };
    let result = law.evaluate(&batch, &mut outputs);
    (result, increment)
}
