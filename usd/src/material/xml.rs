//! Reads the part of XML that MaterialX documents consist of: elements and attributes. Text, comments and processing instructions are
//! skipped; document types are refused, so no entity can grow.

/// Deepest nesting of elements.
const MAX_DEPTH: usize = 64;

/// An element.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Element {
    /// The tag's name.
    pub(super) name: String,
    /// Names and values in order.
    pub(super) attributes: Vec<(String, String)>,
    /// Elements inside.
    pub(super) children: Vec<Element>,
}

impl Element {
    /// The value of an attribute; empty ones count as missing.
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str()).filter(|value| !value.is_empty())
    }
    /// The first child with this name attribute.
    pub(super) fn child_called(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.attribute("name") == Some(name))
    }
}

/// What is wrong, and in which line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct XmlError {
    /// Counted from one.
    pub(super) line: usize,
    /// What was found and expected.
    pub(super) problem: String,
}

struct Reader<'t> {
    text: &'t str,
    at: usize,
}

/// The root element of a document.
pub(super) fn parse(text: &str) -> Result<Element, XmlError> {
    let mut reader = Reader { text, at: 0 };
    let mut open: Vec<Element> = Vec::new();
    while reader.skip_to_tag()? {
        let Some(finished) = reader.tag(&mut open)? else { continue };
        match open.last_mut() {
            Some(parent) => parent.children.push(finished),
            None => return Ok(finished),
        }
    }
    Err(reader.error(match open.last() {
        Some(element) => format!("the document ends inside <{}>", element.name),
        None => "there is no element".to_owned(),
    }))
}

impl<'t> Reader<'t> {
    fn error(&self, problem: impl Into<String>) -> XmlError {
        let line = self.text.as_bytes()[..self.at.min(self.text.len())].iter().filter(|byte| **byte == b'\n').count() + 1;
        XmlError { line, problem: problem.into() }
    }

    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn skip_past(&mut self, end: &str) -> Result<(), XmlError> {
        match self.rest().find(end) {
            Some(offset) => {
                self.at += offset + end.len();
                Ok(())
            }
            None => Err(self.error(format!("'{end}' is missing"))),
        }
    }

    fn take(&mut self, token: &str) -> bool {
        let is_next = self.rest().starts_with(token);
        if is_next {
            self.at += token.len();
        }
        is_next
    }

    fn skip_space(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    /// Goes behind the next `<` of an element's tag; `false` at the end.
    fn skip_to_tag(&mut self) -> Result<bool, XmlError> {
        while let Some(offset) = self.rest().find('<') {
            self.at += offset;
            if self.take("<!--") {
                self.skip_past("-->")?;
            } else if self.take("<?") {
                self.skip_past("?>")?;
            } else if self.take("<![CDATA[") {
                self.skip_past("]]>")?;
            } else if self.rest().starts_with("<!") {
                return Err(self.error("document types are not accepted"));
            } else {
                self.at += 1;
                return Ok(true);
            }
        }
        self.at = self.text.len();
        Ok(false)
    }

    /// Reads a tag; gives the element that it finishes.
    fn tag(&mut self, open: &mut Vec<Element>) -> Result<Option<Element>, XmlError> {
        if self.take("/") {
            let name = self.name()?;
            self.skip_past(">")?;
            return match open.pop() {
                Some(element) if element.name == name => Ok(Some(element)),
                _ => Err(self.error(format!("</{name}> closes nothing"))),
            };
        }
        let mut element = Element { name: self.name()?, ..Element::default() };
        loop {
            self.skip_space();
            if self.take("/>") {
                return Ok(Some(element));
            }
            if self.take(">") {
                if open.len() >= MAX_DEPTH {
                    return Err(self.error(format!("elements are nested deeper than {MAX_DEPTH}")));
                }
                open.push(element);
                return Ok(None);
            }
            element.attributes.push(self.attribute()?);
        }
    }

    fn name(&mut self) -> Result<String, XmlError> {
        let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | ':');
        let length = self.rest().find(|c| !is_name(c)).unwrap_or(self.rest().len());
        if length == 0 {
            return Err(self.error("a name is missing"));
        }
        let name = self.rest()[..length].to_owned();
        self.at += length;
        Ok(name)
    }

    fn attribute(&mut self) -> Result<(String, String), XmlError> {
        let name = self.name()?;
        self.skip_space();
        if !self.take("=") {
            return Err(self.error(format!("the attribute '{name}' has no value")));
        }
        self.skip_space();
        let quote = if self.take("\"") {
            '"'
        } else if self.take("'") {
            '\''
        } else {
            return Err(self.error(format!("the value of '{name}' is not quoted")));
        };
        let Some(length) = self.rest().find(quote) else {
            return Err(self.error(format!("the value of '{name}' does not end")));
        };
        let value = unescaped(&self.rest()[..length]).ok_or_else(|| self.error(format!("the value of '{name}' has an unknown entity")))?;
        self.at += length + 1;
        Ok((name, value))
    }
}

fn unescaped(text: &str) -> Option<String> {
    let mut result = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('&') {
        let (entity, behind) = after.split_once(';')?;
        result.push_str(before);
        result.push(match entity {
            "amp" => '&',
            "lt" => '<',
            "gt" => '>',
            "quot" => '"',
            "apos" => '\'',
            code => char::from_u32(match code.strip_prefix("#x") {
                Some(hexadecimal) => u32::from_str_radix(hexadecimal, 16).ok()?,
                None => code.strip_prefix('#')?.parse().ok()?,
            })?,
        });
        rest = behind;
    }
    result.push_str(rest);
    Some(result)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_and_attributes() {
        let text = "<?xml version=\"1.0\"?>\n<!-- <a> -->\n<a x='1 &lt; 2' y=\"&#x41;\">text<b/><c z = '3'></c></a>";
        let root = parse(text).expect("well formed");
        assert_eq!((root.name.as_str(), root.attribute("x"), root.attribute("y")), ("a", Some("1 < 2"), Some("A")));
        assert_eq!(root.children.len(), 2);
        assert_eq!(root.children[1].attribute("z"), Some("3"));
        let logged = parse(&format!("exported: 2 materials\n{text}")).expect("text before the document is skipped");
        assert_eq!(logged, root);
    }

    #[test]
    fn bad_documents_are_errors_with_lines() {
        for (text, line) in [
            ("", 1),
            ("<a>\n<b></a>", 2),
            ("<a>\n", 2),
            ("<a x=1/>", 1),
            ("\n<!DOCTYPE a [<!ENTITY b 'c'>]><a/>", 2),
            ("<a x='&nope;'/>", 1),
            ("<a x='1", 1),
            ("<", 1),
            ("</a>", 1),
            ("<!-- ", 1),
        ] {
            assert_eq!(parse(text).map_err(|error| error.line), Err(line), "{text}");
        }
        assert!(parse(&"<a>".repeat(1000)).is_err());
    }
}
