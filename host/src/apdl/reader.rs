//! Walks through the statements of a deck: keeps parameters, hands wear commands to the open table, counts the rest.
//!
//! Blocks (`*IF`, `*DO`, `*CREATE`) are not evaluated. What stands in them is passed over, a parameter set there
//! counts as unknown, and a wear command there is an error: reading it as if it always ran once would be a guess.

use std::collections::HashMap;

use super::command;
use super::deck::{LawOption, Scaling, TableRow, WearMaterial};
use super::expression::evaluate;
use super::lexer::{Field, Kind, Span, Statement, is_parameter_name, statements};
use super::note::Note;
use super::parameters::{Parameter, Parameters};
use super::problem::{Fault, Problem};
use super::wear_table::{Finished, WearTable};

type Outcome<T> = Result<T, Box<Fault>>;

/// Commands that give a parameter, their first field, a value that is not known here.
const SETTERS: [&str; 6] = ["*GET", "*ASK", "*DIM", "*DO", "*VGET", "*VREAD"];

/// Commands followed by a line that is a format, not a command.
const FORMATTED: [&str; 4] = ["*VWRITE", "*VREAD", "*MWRITE", "*MSG"];

/// Commands besides TBDATA, TBFIELD and TBTEMP that change the table that is open.
const TABLE_CHANGES: [&str; 4] = ["TBPT", "TBMO", "TBEO", "TBIN"];

/// Commands that change the table they name.
const NAMED_TABLE_CHANGES: [&str; 2] = ["TBDE", "TBCO"];

/// What TBDATA, TBFIELD and TBTEMP refer to.
enum Active {
    Nothing,
    /// A table that is not about wear.
    Other(String),
    Wear(Box<WearTable>),
}

/// A material while its tables are being read.
struct Draft {
    id: i64,
    law: Option<(LawOption, Vec<TableRow>, Span)>,
    scaling: Option<(Scaling, Span)>,
}

pub(super) struct Reader {
    parameters: Parameters,
    drafts: Vec<Draft>,
    active: Active,
    /// The blocks that are open: command and line.
    blocks: Vec<(String, usize)>,
    /// A line that is a format.
    format_line: Option<usize>,
    passed_over: Vec<(String, usize, usize)>,
    passed_over_at: HashMap<String, usize>,
    other_notes: Vec<Note>,
}

impl Reader {
    pub fn read(text: &str) -> Outcome<(Vec<WearMaterial>, Vec<Note>)> {
        let mut reader = Reader {
            parameters: Parameters::default(),
            drafts: Vec::new(),
            active: Active::Nothing,
            blocks: Vec::new(),
            format_line: None,
            passed_over: Vec::new(),
            passed_over_at: HashMap::new(),
            other_notes: Vec::new(),
        };
        for statement in statements(text) {
            if statement.is("/EOF") {
                break;
            }
            if reader.format_line != Some(statement.span.line) {
                reader.statement(&statement)?;
            }
        }
        reader.finish()
    }

    fn statement(&mut self, statement: &Statement<'_>) -> Outcome<()> {
        match statement.kind {
            Kind::Assignment => self.assign(statement.name, &statement.rest, statement.span),
            Kind::ArrayAssignment => self.pass_over("array elements", statement.span),
            Kind::Data => self.pass_over("lines of data", statement.span),
            Kind::Command if statement.name.starts_with('*') => self.star_command(statement),
            Kind::Command if statement.is("TB") => return self.table(statement),
            Kind::Command if statement.begins("TBDA") => {
                return self.in_table(statement, |table, statement, parameters| {
                    table.data(&command::data(statement, parameters)?)
                });
            }
            Kind::Command if statement.begins("TBFI") => {
                return self.in_table(statement, |table, statement, parameters| {
                    table.field_value(command::field_value(statement, parameters)?)
                });
            }
            Kind::Command if statement.begins("TBTE") => {
                return self.in_table(statement, |table, statement, parameters| {
                    table.field_value(command::temperature(statement, parameters)?)
                });
            }
            Kind::Command => {
                self.refuse_table_change(statement)?;
                self.pass_over(&statement.upper_name(), statement.span);
            }
        }
        Ok(())
    }

    /// A parameter's value; a wrong expression matters only to a wear command that uses it.
    fn assign(&mut self, name: &str, value: &Field<'_>, span: Span) {
        if let Some((block, _)) = self.blocks.last() {
            let block = block.clone();
            self.parameters.set_unknown(name, &block, span);
        } else if value.is_blank() {
            self.parameters.remove(name);
        } else {
            let what = format!("parameter {name}");
            let parameter = match evaluate(value, &what, &self.parameters) {
                Ok(value) => Parameter::Value(value),
                Err(fault) => Parameter::Faulty(fault),
            };
            self.parameters.set(name, parameter);
        }
    }

    fn star_command(&mut self, statement: &Statement<'_>) {
        let name = statement.upper_name();
        let span = statement.span;
        let fields = statement.fields().unwrap_or_default();
        let first = fields.first().filter(|f| is_parameter_name(f.text));
        match (name.as_str(), first) {
            ("*SET", Some(parameter)) => {
                let blank = Field { text: "", span: parameter.span };
                let value = fields.get(1).unwrap_or(&blank);
                return self.assign(parameter.text, value, span);
            }
            ("*DEL", Some(all)) if all.text.eq_ignore_ascii_case("ALL") => self.parameters.clear(),
            ("*DEL", Some(parameter)) => self.parameters.remove(parameter.text),
            ("*DO" | "*DOWHILE" | "*CREATE", _) => self.blocks.push((name.clone(), span.line)),
            ("*IF", _) if fields.iter().any(|f| f.text.eq_ignore_ascii_case("THEN")) => {
                self.blocks.push((name.clone(), span.line));
            }
            ("*ENDIF" | "*ENDDO" | "*END", _) => {
                self.blocks.pop();
            }
            _ => {}
        }
        if let Some(parameter) = first
            && SETTERS.contains(&name.as_str())
        {
            self.parameters.set_unknown(parameter.text, &name, span);
        }
        if FORMATTED.contains(&name.as_str()) {
            self.format_line = Some(span.line + 1);
        }
        self.pass_over(&name, span);
    }

    /// TB: the end of the table before it and the start of another.
    fn table(&mut self, statement: &Statement<'_>) -> Outcome<()> {
        self.close_table()?;
        let label = match statement.fields() {
            Some(fields) => fields.first().map_or("", |label| label.text),
            // a blank for the first comma: said by `open_table` if it is about wear
            None => statement.rest.text,
        };
        if !is_wear(label) {
            let end = label.find([',', ' ']).unwrap_or(label.len());
            let title = format!("TB,{}", label[..end].to_ascii_uppercase());
            self.pass_over(&title, statement.span);
            self.active = Active::Other(title);
            return Ok(());
        }
        self.refuse_in_block(statement)?;
        let open = command::open_table(statement, &self.parameters)?;
        let draft = self.drafts.iter().find(|draft| draft.id == open.material);
        let earlier = draft.and_then(|draft| match open.option.is_law() {
            true => draft.law.as_ref().map(|(_, _, span)| *span),
            false => draft.scaling.as_ref().map(|(_, span)| *span),
        });
        if let Some(earlier) = earlier {
            let material = open.material;
            let option = if open.option.is_law() { "a wear law" } else { "a scaling" };
            let option = option.to_owned();
            let fault = Fault::new(Problem::DuplicateOption { material, option }, open.span);
            return Err(fault.beside(earlier, "given here"));
        }
        self.active = Active::Wear(Box::new(WearTable::new(open)));
        Ok(())
    }

    /// A command that fills the table that is open.
    fn in_table(
        &mut self,
        statement: &Statement<'_>,
        fill: impl Fn(&mut WearTable, &Statement<'_>, &Parameters) -> Outcome<()>,
    ) -> Outcome<()> {
        match &mut self.active {
            Active::Nothing => {
                let command = statement.upper_name();
                Err(Fault::new(Problem::NoTable { command }, statement.span))
            }
            Active::Other(title) => {
                let of = format!("{} of {title}", statement.upper_name());
                self.pass_over(&of, statement.span);
                Ok(())
            }
            Active::Wear(_) if !self.blocks.is_empty() => self.refuse_in_block(statement),
            Active::Wear(table) => fill(table, statement, &self.parameters),
        }
    }

    fn refuse_in_block(&self, statement: &Statement<'_>) -> Outcome<()> {
        let Some((block, line)) = self.blocks.last() else {
            return Ok(());
        };
        let problem = Problem::InsideBlock { command: statement.upper_name(), block: block.clone(), line: *line };
        Err(Fault::new(problem, statement.span))
    }

    /// A wear table that is deleted, copied or given points would not be the one that is read.
    fn refuse_table_change(&self, statement: &Statement<'_>) -> Outcome<()> {
        let begins_any = |names: &[&str]| names.iter().any(|four| statement.begins(four));
        let open = matches!(self.active, Active::Wear(_)) && begins_any(&TABLE_CHANGES);
        let named = begins_any(&NAMED_TABLE_CHANGES)
            && statement.fields().and_then(|fields| fields.first().map(|label| is_wear(label.text))).unwrap_or(false);
        if open || named {
            let command = statement.upper_name();
            let problem = Problem::UnreadTableCommand { command };
            return Err(Fault::new(problem, statement.span));
        }
        Ok(())
    }

    fn close_table(&mut self) -> Outcome<()> {
        let Active::Wear(table) = std::mem::replace(&mut self.active, Active::Nothing) else {
            return Ok(());
        };
        let open = *table.open();
        let finished = table.finish()?;
        let draft = self.draft(open.material);
        match finished {
            Finished::Scaling(scaling) => draft.scaling = Some((scaling, open.span)),
            Finished::Law { option, rows, scaled_from } => {
                draft.law = Some((option, rows, open.span));
                self.other_notes.extend(scaled_from.map(|given| Note::DirectionScaled {
                    material: open.material,
                    line: open.span.line,
                    given,
                }));
            }
        }
        Ok(())
    }

    fn draft(&mut self, id: i64) -> &mut Draft {
        let at = self.drafts.iter().position(|draft| draft.id == id);
        let at = at.unwrap_or_else(|| {
            self.drafts.push(Draft { id, law: None, scaling: None });
            self.drafts.len() - 1
        });
        &mut self.drafts[at]
    }

    fn pass_over(&mut self, command: &str, span: Span) {
        match self.passed_over_at.get(command) {
            Some(&at) => self.passed_over[at].1 += 1,
            None => {
                let at = self.passed_over.len();
                self.passed_over_at.insert(command.to_owned(), at);
                self.passed_over.push((command.to_owned(), 1, span.line));
            }
        }
    }

    fn finish(mut self) -> Outcome<(Vec<WearMaterial>, Vec<Note>)> {
        self.close_table()?;
        let mut materials = Vec::new();
        for Draft { id, law, scaling } in self.drafts {
            match (law, scaling) {
                (Some((option, tables, span)), scaling) => materials.push(WearMaterial {
                    id,
                    option,
                    tables,
                    scaling: scaling.map(|(scaling, _)| scaling),
                    span,
                }),
                (None, Some((_, span))) => {
                    let material = id;
                    return Err(Fault::new(Problem::ScalingWithoutLaw { material }, span));
                }
                (None, None) => {}
            }
        }
        let note = |(command, count, first_line)| Note::PassedOver { command, count, first_line };
        let mut notes: Vec<Note> = self.passed_over.into_iter().map(note).collect();
        notes.extend(self.other_notes);
        Ok((materials, notes))
    }
}

/// Only the first four letters of a label count.
fn is_wear(label: &str) -> bool {
    let head = label.get(..4);
    head.is_some_and(|head| head.eq_ignore_ascii_case("WEAR"))
}
